// Cutting a triangle's box in two at a plane.
// Based on: Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", 2009, section 4.
#include "accel/triangle_split.h"

#include <array>
#include <limits>

#include <glm/gtc/type_ptr.hpp>

namespace lavalight {

namespace {

using Limits = std::numeric_limits<float>;

// Where the edge from a to b meets the plane, as a box that contains the exact point.
BuildBox cutEdge(const glm::vec3& a, const glm::vec3& b, float fraction) {
    const glm::vec3 point = a + (b - a) * fraction;
    // Six roundings, those of the fraction included, come to at most 12 half epsilons of the larger end; the
    // smallest normal number stands for what underflow loses. Without the margin a sliver of the triangle
    // could lie in neither box.
    const glm::vec3 error = 8.0f * Limits::epsilon() * glm::max(glm::abs(a), glm::abs(b)) + Limits::min();
    return {point - error, point + error};
}

BuildBox unite(const BuildBox& a, const BuildBox& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

BuildBox intersect(const BuildBox& a, const BuildBox& b) {
    return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

} // namespace

SplitBoxes splitTriangle(const Triangle& triangle, const BuildBox& box, int axis, float position) {
    const std::array<glm::vec3, 3> corners{triangle.v0, triangle.v1, triangle.v2};
    const std::array<float, 3> along{glm::value_ptr(corners[0])[axis], glm::value_ptr(corners[1])[axis],
                                     glm::value_ptr(corners[2])[axis]};
    const std::array<bool, 3> isLeft{along[0] <= position, along[1] <= position, along[2] <= position};
    const int leftCount = isLeft[0] + isLeft[1] + isLeft[2];
    if (leftCount == 0)
        return {{}, intersect(triangleBox(triangle), box)};
    if (leftCount == 3)
        return {intersect(triangleBox(triangle), box), {}};

    // One corner is alone on its side, and the plane cuts the two edges that meet there.
    const bool loneIsLeft = leftCount == 1;
    const size_t lone = isLeft[0] == loneIsLeft ? 0 : isLeft[1] == loneIsLeft ? 1 : 2;
    const size_t b = (lone + 1) % 3;
    const size_t c = (lone + 2) % 3;
    const float depth = position - along[lone];
    const BuildBox cut = unite(cutEdge(corners[lone], corners[b], depth / (along[b] - along[lone])),
                               cutEdge(corners[lone], corners[c], depth / (along[c] - along[lone])));
    const BuildBox tip = intersect(unite(cut, {corners[lone], corners[lone]}), box);
    const BuildBox rest =
        intersect(unite(cut, {glm::min(corners[b], corners[c]), glm::max(corners[b], corners[c])}), box);
    SplitBoxes parts = loneIsLeft ? SplitBoxes{tip, rest} : SplitBoxes{rest, tip};
    float& leftEnd = glm::value_ptr(parts.left.upper)[axis];
    float& rightStart = glm::value_ptr(parts.right.lower)[axis];
    leftEnd = glm::min(leftEnd, position);
    rightStart = glm::max(rightStart, position);
    return parts;
}

} // namespace lavalight
