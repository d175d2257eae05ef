// A binary tree over lights, so that one can be picked by what it brings to a point without asking all of
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light/light_bounds.h"

namespace lavalight {

// Bits of LightTree::paths; no tree is deeper.
constexpr uint32_t kMostLightTreeLevels = 32;

struct LightTreeNode {
    LightBounds bounds;
    bool isLeaf = true;
    uint32_t index = 0; // leaf: the light; else the first of two children, which are neighbours
};

struct LightTree {
    std::vector<LightTreeNode> nodes; // the root first; empty without lights
    // The way to each light's leaf: bit i is set where, i levels below the root, it is in the second child.
    std::vector<uint32_t> paths;
};

[[nodiscard]] LightTree buildLightTree(std::span<const LightBounds> lights);

} // namespace lavalight
