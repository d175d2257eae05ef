// Has Embree group triangles by surface areas, and lays the groups out.
#include "accel/bvh16.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <functional>
#include <limits>
#include <new>

#include <fmt/format.h>

#include "accel/embree_input.h"
#include "base/error.h"

namespace lavalight {
namespace {

// A node with children, or a leaf with the ids of its triangles.
struct Group {
    bool isLeaf = false;
    uint32_t count = 0;
    std::array<const Group*, kBvh16Width> children{};
    std::array<uint32_t, kBvh16LeafWidth> triangles{};
};

Group* newGroup(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Group), alignof(Group))) Group;
}

void* createGroup(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return newGroup(allocator);
}

void setGroupChildren(void* node, void** children, unsigned count, void*) {
    Group& group = *static_cast<Group*>(node);
    group.count = count;
    std::copy_n(reinterpret_cast<Group**>(children), count, group.children.begin());
}

void ignoreBounds(void*, const RTCBounds**, unsigned, void*) {
} // the layout computes them, in the scene's scale

void* createGroupOfTriangles(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                             size_t count, void*) {
    assert(count <= kBvh16LeafWidth);
    Group* leaf = newGroup(allocator);
    leaf->isLeaf = true;
    for (size_t i = 0; i < count; ++i)
        leaf->triangles[leaf->count++] = primitives[i].primID;
    return leaf;
}

// Null where memory runs out. Embree halves lists without looking at areas in the last eight levels.
const Group* buildGroups(std::span<const Triangle> triangles, const Bounds& bounds, RTCBVH bvh) {
    const BuildScale scale(bounds);
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(triangles.size());
    for (uint32_t id = 0; id < triangles.size(); ++id)
        primitives.push_back(scale.primitive(triangleBox(triangles[id]), id));
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    // Embree's best without splits. Splits made bounce rays slower by 3 to 18 %: docs/notes/performance.md.
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = kBvh16Width;
    arguments.sahBlockSize = arguments.minLeafSize = arguments.maxLeafSize = kBvh16LeafWidth;
    arguments.maxDepth = kMaxBvh16Levels;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createGroup;
    arguments.setNodeChildren = setGroupChildren;
    arguments.setNodeBounds = ignoreBounds;
    arguments.createLeaf = createGroupOfTriangles;
    return static_cast<const Group*>(rtcBuildBVH(&arguments));
}

// Lays groups out, depth first.
class Layout {
  public:
    Layout(Bvh16& bvh, std::span<const Triangle> triangles, std::span<const uint32_t> materials)
        : bvh_(&bvh), triangles_(triangles), materials_(materials) {}

    // Larger children come first: rays that any hit ends meet something there soonest.
    void addRoot(std::span<const Group* const> children) { placeNode(children); }

  private:
    struct Placed {
        uint32_t child;
        BuildBox box;
    };

    Placed place(const Group& group) {
        return group.isLeaf ? placeLeaf(std::span(group.triangles).first(group.count))
                            : placeNode(std::span(group.children).first(group.count));
    }
    Placed placeLeaf(std::span<const uint32_t> ids);
    Placed placeNode(std::span<const Group* const> children);

    Bvh16* bvh_;
    std::span<const Triangle> triangles_;
    std::span<const uint32_t> materials_;
};

Layout::Placed Layout::placeLeaf(std::span<const uint32_t> ids) {
    Placed placed{kBvh16LeafBit | static_cast<uint32_t>(bvh_->leaves.size()), {}};
    Bvh16Leaf& leaf = bvh_->leaves.emplace_back();
    leaf.count = static_cast<uint32_t>(ids.size());
    for (size_t lane = 0; lane < ids.size(); ++lane) {
        const Triangle& triangle = triangles_[ids[lane]];
        const glm::vec3 corners[] = {triangle.v0, triangle.v1, triangle.v2};
        for (size_t corner = 0; corner < 3; ++corner)
            for (size_t axis = 0; axis < 3; ++axis)
                leaf.corners[corner][axis][lane] = corners[corner][static_cast<int>(axis)];
        leaf.triangles[lane] = ids[lane];
        leaf.materials[lane] = materials_.empty() ? 0u : materials_[ids[lane]];
        placed.box.extend(triangleBox(triangle));
    }
    return placed;
}

Layout::Placed Layout::placeNode(std::span<const Group* const> children) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Placed placed{static_cast<uint32_t>(bvh_->nodes.size()), {}};
    bvh_->nodes.emplace_back();
    std::vector<Placed> below;
    for (const Group* child : children)
        below.push_back(place(*child));
    std::ranges::stable_sort(below, std::greater(), [](const Placed& child) { return child.box.area(); });
    Bvh16Node& node = bvh_->nodes[placed.child];
    for (size_t plane = 0; plane < 6; ++plane)
        node.planes[plane].fill(plane < 3 ? kInfinity : -kInfinity);
    node.children.fill(kBvh16LeafBit);
    for (size_t lane = 0; lane < below.size(); ++lane) {
        const auto& [child, box] = below[lane];
        node.children[lane] = child;
        for (size_t axis = 0; axis < 3; ++axis) {
            node.planes[axis][lane] = box.lower[static_cast<int>(axis)];
            node.planes[3 + axis][lane] = box.upper[static_cast<int>(axis)];
        }
        placed.box.extend(box);
    }
    return placed;
}

void reserve(Bvh16& bvh, const Group& root) {
    size_t nodes = root.isLeaf ? 1 : 0; // a leaf gets a root above it
    size_t leaves = 0;
    const auto count = [&](const Group& group, const auto& self) -> void {
        ++(group.isLeaf ? leaves : nodes);
        for (uint32_t i = 0; i < group.count && !group.isLeaf; ++i)
            self(*group.children[i], self);
    };
    count(root, count);
    bvh.nodes.reserve(nodes);
    bvh.leaves.reserve(leaves);
}

void buildNonEmpty(Bvh16& bvh, std::span<const Triangle> triangles, std::span<const uint32_t> materials) {
    const BuildMemory memory = makeBuildMemory();
    const Group* root = buildGroups(triangles, bvh.bounds, memory.bvh.get());
    if (root == nullptr)
        throw Error(fmt::format("cannot build the BVH of {} triangles: Embree's error {} (4: out of memory)",
                                triangles.size(), static_cast<int>(rtcGetDeviceError(memory.device.get()))));
    reserve(bvh, *root);
    Layout(bvh, triangles, materials)
        .addRoot(root->isLeaf ? std::span(&root, 1) : std::span(root->children).first(root->count));
}

} // namespace

uint64_t Bvh16::bytes() const {
    return nodes.size() * sizeof(Bvh16Node) + leaves.size() * sizeof(Bvh16Leaf);
}

Bvh16 buildBvh16(std::span<const Triangle> triangles, std::span<const uint32_t> materials) {
    assert(materials.empty() || materials.size() == triangles.size());
    const auto start = std::chrono::steady_clock::now();
    Bvh16 bvh;
    bvh.bounds = boundsToBuildIn(triangles);
    if (triangles.empty()) {
        bvh.leaves.emplace_back();
        Layout(bvh, {}, {}).addRoot({});
    } else {
        buildNonEmpty(bvh, triangles, materials);
    }
    bvh.buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

} // namespace lavalight
