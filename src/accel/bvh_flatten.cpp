// From the binary tree to the quantised 4-wide nodes of shared/bvh.h.
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
    constexpr int kSmallest = -126; // of normal floats: devices may take smaller ones for 0
    const float reach = std::max(std::abs(lower), std::abs(upper));
    int exponent = reach > 0.0f ? std::max(kSmallest, std::ilogb(reach) - 23) : kSmallest;
    while (std::ldexp(255.0, exponent) < differenceUp(upper, lower))
        ++exponent;
    return exponent;
}

void setPlane(BvhNode& node, int plane, size_t child, double value) {
    assert(value >= 0.0 && value <= 255.0);
    node.planes[plane] |= static_cast<uint32_t>(value) << (8 * child);
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
        for (size_t i = 0; i < 4; ++i) {
            const bool empty = i >= children.size();
            const double lower =
                empty ? 255.0
                      : differenceDown(children[i].subtree->box.lower[axis], node.origin[axis]) / step;
            const double upper =
                empty ? 0.0 : differenceUp(children[i].subtree->box.upper[axis], node.origin[axis]) / step;
            setPlane(node, axis, i, std::max(std::floor(lower), 0.0));
            setPlane(node, axis + 3, i, std::ceil(upper));
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
            emitChildren(0, {});
        return std::move(bvh_);
    }

  private:
    Bvh bvh_;

    void emit(uint32_t index, const BuildNode& node, uint32_t level) {
        bvh_.levels = std::max(bvh_.levels, level);
        const std::vector<WideChild> children = wideChildren(node);
        emitChildren(index, children);
        for (size_t i = 0; i < children.size(); ++i)
            if (!children[i].isLeaf)
                emit(bvh_.nodes[index].children[static_cast<int>(i)], *children[i].subtree, level + 1);
    }

    void emitChildren(uint32_t index, const std::vector<WideChild>& children) {
        BvhNode node{};
        if (!children.empty())
            quantise(children, node);
        else
            std::fill_n(node.planes, 3, 0xffffffffu); // lower 255 above upper 0
        for (size_t i = 0; i < 4; ++i) {
            uint32_t& reference = node.children[static_cast<int>(i)];
            if (i >= children.size())
                reference = kLeafBit;
            else
                reference = children[i].isLeaf ? appendLeaf(*children[i].subtree) : appendNode();
        }
        bvh_.nodes[index] = node;
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

    // Parts of one triangle that ended up in one leaf become one again.
    uint32_t appendLeaf(const BuildNode& leaf) {
        std::vector<uint32_t>& all = bvh_.leafTriangles;
        requireBvhFits(all.size() + leaf.count, 0);
        const auto first = static_cast<uint32_t>(all.size());
        appendReferences(leaf);
        std::sort(all.begin() + first, all.end());
        all.erase(std::unique(all.begin() + first, all.end()), all.end());
        const auto count = static_cast<uint32_t>(all.size() - first);
        return kLeafBit | count << kLeafCountShift | first;
    }
};

} // namespace

Bvh flattenTree(const BuildNode* root) {
    Bvh bvh = Flattener().run(root);
    assert(bvh.levels <= kMaxBvhLevels);
    return bvh;
}

} // namespace lavalight
