// What is known of a light, or of many, without looking at each: where they are and which way they shine.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "light/emitters.h"
#include "scene/scene.h"

namespace lavalight {

// Directions of emission: normals lie within `spread` around the axis, and light leaves within `falloff`
// around each of them. Both angles are in radians, at most pi together where it matters.
struct LightCone {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double spread = 0.0;
    double falloff = 0.0;
};

struct LightBounds {
    glm::dvec3 lower{0.0};
    glm::dvec3 upper{0.0};
    LightCone cone;
    bool isTwoSided = false; // the opposite directions too
    double intensity = 0.0;  // W/sr, mean of the channels, along the brightest direction; of many: their sum
    double range = kNoRange; // metres, of the light that reaches furthest

    [[nodiscard]] glm::dvec3 center() const { return 0.5 * (lower + upper); }
};

// Bounds of everything that is in either.
[[nodiscard]] LightBounds unite(const LightBounds& a, const LightBounds& b);

// Bounds of each emitter, in their order.
[[nodiscard]] std::vector<LightBounds> boundsOf(const Scene& scene, const Emitters& emitters);
// Bounds of a point light or a spot.
[[nodiscard]] LightBounds boundsOf(const PunctualLight& light);

} // namespace lavalight
