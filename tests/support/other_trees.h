// Trees over the same triangles that no render would get: for tests of what must not depend on the tree.
#pragma once

#include <span>

#include "accel/bvh.h"

namespace lavalight::test {

// A tree by the builder of last resort. There must be triangles.
[[nodiscard]] Bvh medianBvh(std::span<const Triangle> triangles);

// The tree with the triangles of each leaf in reverse order.
[[nodiscard]] Bvh withLeavesReversed(Bvh bvh);

} // namespace lavalight::test
