// Octahedral packing of normals.
#include <algorithm>
#include <cmath>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include "device_scene/octahedral.h"

namespace lavalight {
namespace {

// The map's inverse by its definition: the octahedron's lower half is folded over the diagonals of the
// square.
glm::dvec3 decoded(uint32_t bits) {
    const glm::dvec2 e(glm::unpackSnorm2x16(bits));
    glm::dvec3 v(e, 1.0 - std::abs(e.x) - std::abs(e.y));
    if (v.z < 0.0)
        v = {(1.0 - std::abs(e.y)) * (e.x < 0.0 ? -1.0 : 1.0),
             (1.0 - std::abs(e.x)) * (e.y < 0.0 ? -1.0 : 1.0), v.z};
    return glm::normalize(v);
}

TEST(Octahedral, KeepsDirectionsWithinTheDocumentedAngle) {
    double worst = 0.0;
    for (int i = 0; i <= 200; ++i)
        for (int j = 0; j < 400; ++j) {
            const double theta = std::acos(-1.0 + i / 100.0);
            const double phi = j * 0.0157079632679;
            const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta));
            const glm::dvec3 back = decoded(encodeOctahedral(glm::vec3(n)));
            worst = std::max(worst, std::asin(std::min(1.0, glm::length(glm::cross(n, back)))));
            ASSERT_GT(glm::dot(n, back), 0.0);
        }
    EXPECT_LT(worst, 1e-4);
}

TEST(Octahedral, KeepsTheAxesExactly) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 n(0.0f);
            n[axis] = sign;
            const glm::dvec3 back = decoded(encodeOctahedral(n));
            EXPECT_NEAR(back[axis], sign, 1e-9) << "axis " << axis;
        }
}

} // namespace
} // namespace lavalight
