// Builds the binary tree with Embree, spatial splits included, and hands it to the flattening.
#include "accel/bvh.h"

#include <cassert>
#include <chrono>
#include <cmath>
#include <new>
#include <numeric>

#include "accel/build_tree.h"
#include "accel/embree_handles.h"
#include "accel/triangle_split.h"
#include "base/error.h"
#include "base/log.h"

namespace lavalight {

namespace {

// Levels of the binary tree. Embree halves lists without looking at areas in the last eight; collapsed by
// height, 40 levels fill 60 entries of the stack.
constexpr uint32_t kMaxBinaryDepth = 40;
static_assert(3 * (kMaxBinaryDepth / 2) <= kTraversalStackSize);

// What Embree's callbacks know. Embree sees the scene scaled by a power of two to coordinates below 1, which
// is exact and keeps its areas and costs finite and normal at any scale of the scene.
struct BuildContext {
    std::vector<Triangle> scaled;
    double scale = 1.0;
    float triangleCost = 0.0f;
};

// The nearest float that is not above `value`.
float roundDown(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

// Back to the scene's scale, rounded outward.
BuildBox unscaled(const BuildBox& box, double scale) {
    BuildBox result;
    for (int i = 0; i < 3; ++i) {
        result.lower[i] = roundDown(box.lower[i] / scale);
        result.upper[i] = -roundDown(-box.upper[i] / scale);
    }
    return result;
}

RTCBuildPrimitive toPrimitive(const Triangle& scaled, uint32_t id) {
    // Room for numbers that leave the normal range by scaling, which Embree may take for 0.
    constexpr float kPad = 4.0f * std::numeric_limits<float>::min();
    const BuildBox box = triangleBox(scaled);
    const glm::vec3 lower = box.lower - kPad;
    const glm::vec3 upper = box.upper + kPad;
    return {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, id};
}

BuildBox primitiveBox(const RTCBuildPrimitive& p) {
    return {{p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}};
}

void storeBox(const BuildBox& box, RTCBounds& out) {
    out.lower_x = box.lower.x;
    out.lower_y = box.lower.y;
    out.lower_z = box.lower.z;
    out.upper_x = box.upper.x;
    out.upper_y = box.upper.y;
    out.upper_z = box.upper.z;
}

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
    makeReference(*leaf, primitive->primID, unscaled(primitiveBox(*primitive), context.scale),
                  context.triangleCost);
    return leaf;
}

void splitPrimitive(const RTCBuildPrimitive* primitive, unsigned axis, float position, RTCBounds* left,
                    RTCBounds* right, void* user) {
    const auto& context = *static_cast<const BuildContext*>(user);
    const SplitBoxes boxes = splitTriangle(context.scaled[primitive->primID], primitiveBox(*primitive),
                                           static_cast<int>(axis), position);
    storeBox(boxes.left, *left);
    storeBox(boxes.right, *right);
}

// Throws Error for a coordinate out of range.
Bounds boundsOf(std::span<const Triangle> triangles) {
    BuildBox box;
    for (size_t id = 0; id < triangles.size(); ++id) {
        for (const glm::vec3& v : {triangles[id].v0, triangles[id].v1, triangles[id].v2}) {
            const bool inRange = glm::all(glm::lessThanEqual(glm::abs(v), glm::vec3(kMaxCoordinate)));
            if (!inRange) // false for NaN
                throw Error(
                    fmt::format("cannot build the BVH: triangle {} has the vertex ({}, {}, {}); coordinates "
                                "must be finite and at most {}: scale the scene down or repair the mesh",
                                id, v.x, v.y, v.z, kMaxCoordinate));
        }
        box.extend(triangleBox(triangles[id]));
    }
    return triangles.empty() ? Bounds{} : Bounds{box.lower, box.upper};
}

BuildContext makeContext(std::span<const Triangle> triangles, const Bounds& bounds, float triangleCost) {
    const glm::vec3 reach = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    const float largest = glm::max(glm::max(reach.x, reach.y), reach.z);
    BuildContext context{{}, largest > 0.0f ? std::ldexp(1.0, -1 - std::ilogb(largest)) : 1.0, triangleCost};
    const auto scaled = [&](const glm::vec3& v) { return glm::vec3(context.scale * glm::dvec3(v)); };
    context.scaled.reserve(triangles.size());
    for (const Triangle& t : triangles)
        context.scaled.push_back({scaled(t.v0), scaled(t.v1), scaled(t.v2)});
    return context;
}

// The tree lives as long as `bvh`. Null where Embree cannot keep to kMaxBinaryDepth.
const BuildNode* buildEmbreeTree(BuildContext& context, const BvhConfig& config, RTCBVH bvh) {
    const size_t count = context.scaled.size();
    const size_t room = size_t{kMaxTexels / kLeafTriangleTexels};
    const auto wanted = static_cast<size_t>(static_cast<double>(count) * (1.0 + config.splitBudget));
    std::vector<RTCBuildPrimitive> primitives(std::min(wanted, room));
    for (size_t id = 0; id < count; ++id)
        primitives[id] = toPrimitive(context.scaled[id], static_cast<uint32_t>(id));

    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = kMaxBinaryDepth;
    arguments.maxLeafSize = 1;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    arguments.splitPrimitive = splitPrimitive;
    arguments.userPtr = &context;
    return static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
}

Bvh buildNonEmpty(std::span<const Triangle> triangles, const Bounds& bounds, const BvhConfig& config) {
    const EmbreeDevice device(rtcNewDevice(fmt::format("threads={}", config.threads).c_str()));
    const EmbreeBvh arena(device ? rtcNewBVH(device.get()) : nullptr);
    if (!arena)
        throw Error("cannot build the BVH: Embree does not start (out of memory?)");
    BuildContext context = makeContext(triangles, bounds, config.triangleCost);
    if (const BuildNode* root = buildEmbreeTree(context, config, arena.get()))
        return flattenTree(root);
    if (rtcGetDeviceError(device.get()) == RTC_ERROR_OUT_OF_MEMORY)
        throw Error(fmt::format("cannot build the BVH of {} triangles: out of memory", triangles.size()));
    // Triangles whose sizes span dozens of powers of two make surface areas peel off a few at each level.
    std::deque<BuildNode> nodes;
    std::vector<uint32_t> ids(triangles.size());
    std::iota(ids.begin(), ids.end(), 0u);
    return flattenTree(buildMedianTree(triangles, ids, config.triangleCost, nodes));
}

} // namespace

void requireBvhFits(uint64_t leafTriangles, uint64_t nodes) {
    if (leafTriangles * kLeafTriangleTexels > kMaxTexels)
        throw Error(
            fmt::format("cannot build the BVH: {} leaf triangles exceed the {} that fit into a texel buffer: "
                        "simplify the scene",
                        leafTriangles, kMaxTexels / kLeafTriangleTexels));
    if (nodes * kNodeTexels > kMaxTexels)
        throw Error(
            fmt::format("cannot build the BVH: {} nodes exceed the {} that fit into a texel buffer: simplify "
                        "the scene",
                        nodes, kMaxTexels / kNodeTexels));
}

Bvh buildBvh(std::span<const Triangle> triangles, const BvhConfig& config) {
    const auto start = std::chrono::steady_clock::now();
    requireBvhFits(triangles.size(), 0);
    const Bounds bounds = boundsOf(triangles);
    Bvh bvh = triangles.empty() ? flattenTree(nullptr) : buildNonEmpty(triangles, bounds, config);
    bvh.bounds = bounds;
    bvh.buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

} // namespace lavalight
