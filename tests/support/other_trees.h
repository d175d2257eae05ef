// Trees over the same triangles that no render would get: for tests of what must not depend on the tree.
#pragma once

#include <span>

#include "accel/bvh.h"

namespace lavalight::test {

// By the builder of last resort. There must be triangles.
[[nodiscard]] Bvh medianBvh(std::span<const Triangle> triangles);

// The same nodes, with the triangles of each leaf in the opposite order.
[[nodiscard]] Bvh withLeavesReversed(Bvh bvh);

} // namespace lavalight::test
