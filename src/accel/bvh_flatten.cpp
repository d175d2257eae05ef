// From the binary tree to the quantised 8-wide nodes of shared/bvh.h.
// Based on: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
// 2017: the exponents and 8-bit planes.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "accel/build_tree.h"

namespace lavalight {

namespace {

// a - b, rounded down to a double where it does not fit: the difference of floats far apart in size.
double differenceDown(float a, float b) {
    const double difference = double{a} - double{b};
    const bool exact = difference + double{b} == double{a} && double{a} - difference == double{b};
    return exact ? difference : std::nextafter(difference, -HUGE_VAL);
}

double differenceUp(float a, float b) {
    return -differenceDown(b, a);
}

// The smallest exponent, at least that of a float's last bit here, with which 255 steps from lower reach
// upper.
int gridExponent(float lower, float upper) {
    constexpr int kSmallest = -126; // least exponent of normal floats: devices may take smaller ones for 0
    const float reach = std::max(std::abs(lower), std::abs(upper));
    int exponent = reach > 0.0f ? std::max(kSmallest, std::ilogb(reach) - 23) : kSmallest;
    while (std::ldexp(255.0, exponent) < differenceUp(upper, lower))
        ++exponent;
    return exponent;
}

void setPlane(glm::uvec2& plane, size_t slot, double value) {
    assert(value >= 0.0 && value <= 255.0);
    plane[static_cast<int>(slot / 4)] |= static_cast<uint32_t>(value) << (8 * (slot % 4));
}

void quantise(const std::vector<WideChild>& children, BvhNode& node) {
    BuildBox box;
    for (const WideChild& child : children)
        box.extend(child.subtree->box);
    node.origin = box.lower;
    for (int axis = 0; axis < 3; ++axis) {
        const int exponent = gridExponent(box.lower[axis], box.upper[axis]);
        node.exponents |= static_cast<uint32_t>(exponent + 127) << (8 * axis);
        const double step = std::ldexp(1.0, exponent);
        for (size_t i = 0; i < kBvhWidth; ++i) {
            const bool empty = i >= children.size();
            const double lower =
                empty ? 255.0
                      : differenceDown(children[i].subtree->box.lower[axis], node.origin[axis]) / step;
            const double upper =
                empty ? 0.0 : differenceUp(children[i].subtree->box.upper[axis], node.origin[axis]) / step;
            setPlane(node.lower[axis], i, std::max(std::floor(lower), 0.0));
            setPlane(node.upper[axis], i, std::ceil(upper));
        }
    }
}

class Flattener {
  public:
    [[nodiscard]] Bvh run(const BuildNode* root) {
        bvh_.nodes.emplace_back();
        if (root)
            emit(0, *root, 1);
        else
            bvh_.nodes[0] = emptyNode();
        return std::move(bvh_);
    }

  private:
    Bvh bvh_;

    static BvhNode emptyNode() {
        BvhNode node{};
        for (glm::uvec2& lower : node.lower)
            lower = glm::uvec2(0xffffffffu); // 255, above upper 0
        return node;
    }

    void emit(uint32_t index, const BuildNode& node, uint32_t level) {
        bvh_.levels = std::max(bvh_.levels, level);
        const std::vector<WideChild> children = wideChildren(node);
        emitNode(index, children);
        uint32_t next = bvh_.nodes[index].children.firstNode;
        for (const WideChild& child : children)
            if (!child.isLeaf)
                emit(next++, *child.subtree, level + 1);
    }

    void emitNode(uint32_t index, const std::vector<WideChild>& children) {
        BvhNode node{};
        quantise(children, node);
        node.children.firstNode = static_cast<uint32_t>(bvh_.nodes.size());
        node.children.firstTriangle = static_cast<uint32_t>(bvh_.leafTriangles.size());
        for (size_t i = 0; i < children.size(); ++i)
            node.children.slots[static_cast<int>(i / 4)] |= appendChild(node.children, children[i])
                                                            << (8 * (i % 4));
        bvh_.nodes[index] = node;
    }

    static_assert((kBvhWidth - 1) * kMaxLeafTriangles <= kSlotOffsetMask);
    // Appends a child and returns what its slot says.
    uint32_t appendChild(const BvhChildren& first, const WideChild& child) {
        if (!child.isLeaf)
            return kSlotIsNode << kSlotCountShift | (appendNode() - first.firstNode);
        const auto offset = static_cast<uint32_t>(bvh_.leafTriangles.size()) - first.firstTriangle;
        return appendLeaf(*child.subtree) << kSlotCountShift | offset;
    }

    uint32_t appendNode() {
        requireBvhFits(0, bvh_.nodes.size() + 1);
        bvh_.nodes.emplace_back();
        return static_cast<uint32_t>(bvh_.nodes.size() - 1);
    }

    void appendReferences(const BuildNode& node) {
        if (node.count == 1) {
            bvh_.leafTriangles.push_back(node.triangle);
            return;
        }
        for (const BuildNode* child : node.children)
            appendReferences(*child);
    }

    // Parts of one triangle that ended up in one leaf become one again. Returns how many triangles it has.
    uint32_t appendLeaf(const BuildNode& leaf) {
        std::vector<uint32_t>& all = bvh_.leafTriangles;
        requireBvhFits(all.size() + leaf.count, 0);
        const auto first = static_cast<uint32_t>(all.size());
        appendReferences(leaf);
        std::sort(all.begin() + first, all.end());
        all.erase(std::unique(all.begin() + first, all.end()), all.end());
        return static_cast<uint32_t>(all.size() - first);
    }
};

} // namespace

Bvh flattenTree(const BuildNode* root) {
    Bvh bvh = Flattener().run(root);
    assert(bvh.levels <= kMaxBvhLevels);
    return bvh;
}

} // namespace lavalight
