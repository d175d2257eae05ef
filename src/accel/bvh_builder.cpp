// Splits large triangles, builds the binary tree with Embree, and hands it to the flattening.
#include "accel/bvh.h"

#include <cassert>
#include <chrono>
#include <new>
#include <numeric>

#include "accel/build_tree.h"
#include "accel/embree_input.h"
#include "accel/presplit.h"
#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"
#include "image/pixel_limit.h"
#include "shared/triangle.h"

namespace lavalight {

namespace {

// Levels of the binary tree, of which collapsing makes at most as many. Embree halves lists without looking
// at areas in the last eight.
constexpr uint32_t kMaxBinaryDepth = kMaxBvhLevels;

// What Embree's callbacks know.
struct BuildContext {
    std::span<const Fragment> fragments;
    float triangleCost = 0.0f;
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
}

void setChildren(void* node, void** children, unsigned, void* user) {
    makeInner(*static_cast<BuildNode*>(node), *static_cast<BuildNode*>(children[0]),
              *static_cast<BuildNode*>(children[1]), static_cast<const BuildContext*>(user)->triangleCost);
}

void setBounds(void*, const RTCBounds**, unsigned, void*) {} // makeInner takes them from the children

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitive,
                 [[maybe_unused]] size_t count, void* user) {
    assert(count == 1);
    const auto& context = *static_cast<const BuildContext*>(user);
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
    const Fragment& fragment = context.fragments[primitive->primID];
    makeReference(*leaf, fragment.triangle, fragment.box, context.triangleCost);
    return leaf;
}

// The tree lives as long as `bvh`. Null where Embree cannot keep to kMaxBinaryDepth.
const BuildNode* buildEmbreeTree(BuildContext& context, const Bounds& bounds, RTCBVH bvh) {
    const BuildScale scale(bounds);
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(context.fragments.size());
    for (uint32_t id = 0; id < context.fragments.size(); ++id)
        primitives.push_back(scale.primitive(context.fragments[id].box, id));
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    // Embree's best without splits, which presplit() has made.
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = kMaxBinaryDepth;
    arguments.maxLeafSize = 1;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    arguments.userPtr = &context;
    return static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
}

Bvh buildNonEmpty(std::span<const Triangle> triangles, const Bounds& bounds, const BvhConfig& config) {
    const BuildMemory memory = makeBuildMemory(config.threads);
    const std::vector<Fragment> fragments = presplit(triangles, bounds, config.splitBudget);
    requireBvhFits(fragments.size(), 0);
    BuildContext context{fragments, config.triangleCost};
    if (const BuildNode* root = buildEmbreeTree(context, bounds, memory.bvh.get()))
        return flattenTree(root);
    if (rtcGetDeviceError(memory.device.get()) == RTC_ERROR_OUT_OF_MEMORY)
        throw Error(fmt::format("cannot build the BVH of {} triangles: out of memory", triangles.size()));
    // Triangles whose sizes span dozens of powers of two make surface areas peel off a few at each level.
    std::deque<BuildNode> nodes;
    std::vector<uint32_t> ids(triangles.size());
    std::iota(ids.begin(), ids.end(), 0u);
    return flattenTree(buildMedianTree(triangles, ids, config.triangleCost, nodes));
}

} // namespace

void requireBvhFits(uint64_t leafTriangles, uint64_t nodes) {
    if (leafTriangles * kTriangleTexels > kMostTexels)
        throw Error(
            fmt::format("cannot build the BVH: {} leaf triangles exceed the {} that fit into a texel buffer: "
                        "simplify the scene",
                        leafTriangles, kMostTexels / kTriangleTexels));
    static_assert(kMaxNodes * kNodeTexels <= kMostTexels);
    if (nodes > kMaxNodes)
        throw Error(fmt::format(
            "cannot build the BVH: {} nodes exceed the {} that traversal can number: simplify the scene",
            nodes, kMaxNodes));
}

Bvh buildBvh(std::span<const Triangle> triangles, const BvhConfig& config) {
    const auto start = std::chrono::steady_clock::now();
    requireBvhFits(triangles.size(), 0);
    const Bounds bounds = boundsToBuildIn(triangles);
    Bvh bvh = triangles.empty() ? flattenTree(nullptr) : buildNonEmpty(triangles, bounds, config);
    bvh.bounds = bounds;
    bvh.buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

} // namespace lavalight
