// Cutting a triangle's box in two at a plane, for spatial splits.
#pragma once

#include "accel/build_tree.h"

namespace lavalight {

struct SplitBoxes {
    BuildBox left, right; // lower > upper where nothing of the triangle is left on that side
};

// Boxes of the parts of `triangle` inside `box` at either side of the plane `axis` = `position`. Each
// contains its part of the exact triangle: rounding goes outward.
[[nodiscard]] SplitBoxes splitTriangle(const Triangle& triangle, const BuildBox& box, int axis,
                                       float position);

} // namespace lavalight
