// A tree over lights, so that one can be picked by what it brings to a point without asking all of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light/light_bounds.h"

namespace lavalight {

// No tree is deeper: kLightTreeChildBits of LightTree::paths for each level.
constexpr uint32_t kMostLightTreeLevels = 10;

struct LightTreeNode {
    LightBounds bounds;
    bool isLeaf = true;
    // Leaf: the light; else the first of kLightTreeWidth children, which are neighbours. Those that are
    // missing are leaves without intensity.
    uint32_t index = 0;
};

struct LightTree {
    std::vector<LightTreeNode> nodes; // the root first; empty without lights
    // The way to each light's leaf: which child of the root, in the lowest bits, then which of that one's.
    std::vector<uint32_t> paths;
};

[[nodiscard]] LightTree buildLightTree(std::span<const LightBounds> lights);

} // namespace lavalight
