// Cutting a triangle's box in two at a plane.
// Based on: Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", 2009, section 4.
#include "accel/triangle_split.h"

#include <array>
#include <limits>

namespace lavalight {

namespace {

using Limits = std::numeric_limits<float>;

void extend(BuildBox& box, const glm::vec3& point, const glm::vec3& error) {
    box.extend({point - error, point + error});
}

BuildBox intersection(const BuildBox& a, const BuildBox& b) {
    return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

} // namespace

SplitBoxes splitTriangle(const Triangle& triangle, const BuildBox& box, int axis, float position) {
    const std::array<glm::vec3, 3> corners{triangle.v0, triangle.v1, triangle.v2};
    SplitBoxes parts;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec3& a = corners[i];
        const glm::vec3& b = corners[(i + 1) % 3];
        if (a[axis] <= position)
            extend(parts.left, a, glm::vec3(0.0f));
        if (a[axis] >= position)
            extend(parts.right, a, glm::vec3(0.0f));
        if ((a[axis] < position && b[axis] > position) || (a[axis] > position && b[axis] < position)) {
            const glm::vec3 crossing = a + (b - a) * ((position - a[axis]) / (b[axis] - a[axis]));
            // Six roundings come to at most 12 half epsilons of the larger end; the smallest normal number
            // stands for what underflow loses. Without the margin a sliver of the triangle could lie in
            // neither box.
            const glm::vec3 error =
                8.0f * Limits::epsilon() * glm::max(glm::abs(a), glm::abs(b)) + Limits::min();
            extend(parts.left, crossing, error);
            extend(parts.right, crossing, error);
        }
    }
    parts.left.upper[axis] = std::min(parts.left.upper[axis], position);
    parts.right.lower[axis] = std::max(parts.right.lower[axis], position);
    return {intersection(parts.left, box), intersection(parts.right, box)};
}

} // namespace lavalight
