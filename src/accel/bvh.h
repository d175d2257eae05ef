// The bounding volume hierarchy that rays traverse: built on the host, read by kernels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/triangle.h"
#include "scene/scene.h"
#include "shared/bvh.h"

namespace lavalight {

struct BvhConfig {
    float triangleCost = 0.3f; // cost of a triangle's test relative to that of a node's boxes
    float splitBudget = 0.2f;  // splitting large triangles may add this share of references
    uint32_t threads = 0;      // 0: by threadLimit(); the tree does not depend on it
};

struct Bvh {
    std::vector<BvhNode> nodes;          // node 0 is the root; a node's inner children are neighbours
    std::vector<uint32_t> leafTriangles; // triangle ids in leaf order; split triangles repeat
    uint32_t levels = 0;                 // levels of nodes; at most kMaxBvhLevels
    Bounds bounds;                       // box around all triangles; both corners 0 without any
    double buildSeconds = 0.0;
};

// Builds by surface areas over triangles of which large ones have been split. Any number of triangles is
// fine, none and degenerate ones too: those never hit. Throws Error for a coordinate that is not finite or
// beyond kMaxCoordinate, and for scenes beyond requireBvhFits.
[[nodiscard]] Bvh buildBvh(std::span<const Triangle> triangles, const BvhConfig& config = {});

// Throws Error, naming the figure, unless that many leaf triangles fit into a texel buffer of kMostTexels,
// and nodes are at most kMaxNodes.
void requireBvhFits(uint64_t leafTriangles, uint64_t nodes);

} // namespace lavalight
