#include "support/other_trees.h"

#include <algorithm>
#include <deque>
#include <numeric>
#include <vector>

#include "accel/build_tree.h"
#include "support/bvh_walk.h"

namespace lavalight::test {

Bvh medianBvh(std::span<const Triangle> triangles) {
    std::deque<BuildNode> nodes;
    std::vector<uint32_t> ids(triangles.size());
    std::iota(ids.begin(), ids.end(), 0u);
    return flattenTree(buildMedianTree(triangles, ids, BvhConfig{}.triangleCost, nodes));
}

Bvh withLeavesReversed(Bvh bvh) {
    std::vector<uint32_t>& triangles = bvh.leafTriangles;
    forEachSlot(bvh, [&](uint32_t node, uint32_t slot, uint32_t) {
        const uint32_t reference = childReference(bvh.nodes[node], slot);
        if (!isLeaf(reference))
            return;
        const auto first = triangles.begin() + (reference & kLeafFirstMask);
        std::reverse(first, first + (reference >> kLeafCountShift & kLeafCountMask));
    });
    return bvh;
}

} // namespace lavalight::test
