// Large triangles in pieces, before the tree is built.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/build_tree.h"

namespace lavalight {

// A triangle, or the part of it that lies in the box. The box contains that part exactly: rounding goes
// outward.
struct Fragment {
    uint32_t triangle = 0;
    BuildBox box;
};

// All triangles, those that fill their boxes worst in at most `budget` x their number more pieces than there
// are triangles. Pieces of one triangle follow each other and cover it.
[[nodiscard]] std::vector<Fragment> presplit(std::span<const Triangle> triangles, const Bounds& bounds,
                                             float budget);

} // namespace lavalight
