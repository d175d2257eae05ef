// The bounding volume hierarchy that the host traverses (src/hosted/bvh16_rays.h): the boxes of sixteen
// children, or the corners of eight triangles, lie side by side for vector units.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/triangle.h"

namespace lavalight {

inline constexpr uint32_t kBvh16Width = 16;         // children of a node
inline constexpr uint32_t kBvh16LeafWidth = 8;      // triangles of a leaf
inline constexpr uint32_t kBvh16LeafBit = 1u << 31; // of a child that is a leaf; the rest is its index
inline constexpr uint32_t kMaxBvh16Levels = 40;     // of nodes

// Boxes that hold their triangles exactly. A child that is missing has the box from infinity to -infinity,
// and refers to the first leaf.
struct alignas(64) Bvh16Node {
    std::array<std::array<float, kBvh16Width>, 6> planes; // lower x, y, z, upper x, y, z
    std::array<uint32_t, kBvh16Width> children;           // those with larger boxes first, missing ones last
};

// A triangle that is missing has three equal corners, which no ray hits.
struct alignas(64) Bvh16Leaf {
    using Floats = std::array<float, kBvh16LeafWidth>;
    std::array<std::array<Floats, 3>, 3> corners;    // by corner and axis
    std::array<uint32_t, kBvh16LeafWidth> triangles; // their ids
    std::array<uint32_t, kBvh16LeafWidth> materials; // their material words (shared/scene.h)
    uint32_t count;                                  // of triangles that are there, the first lanes
};

struct Bvh16 {
    std::vector<Bvh16Node> nodes;  // node 0 is the root, and always there
    std::vector<Bvh16Leaf> leaves; // at least one
    Bounds bounds;                 // box around all triangles; both corners 0 without any
    double buildSeconds = 0.0;

    [[nodiscard]] uint64_t bytes() const;
};

// Builds by surface areas, at most kMaxBvh16Levels high. Each triangle is in one leaf. Any number of
// triangles is fine, none and degenerate ones too: those never hit. Throws Error for a coordinate that is not
// finite or beyond kMaxCoordinate, and where Embree fails. `materials` has a word of each triangle; or
// none, where all are 0.
[[nodiscard]] Bvh16 buildBvh16(std::span<const Triangle> triangles, std::span<const uint32_t> materials = {});

} // namespace lavalight
