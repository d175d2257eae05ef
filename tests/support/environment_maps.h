// Environment maps made in code, and what tests know about maps.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "image/image.h"

namespace lavalight::test {

[[nodiscard]] Image constantMap(uint32_t width, uint32_t height, const glm::vec3& radiance);

// A map with values from 0 to 1, a third of its texels black.
[[nodiscard]] Image randomMap(uint32_t width, uint32_t height, uint32_t seed);

// A map with one bright texel on a faint sky.
[[nodiscard]] Image sunMap(uint32_t width, uint32_t height, const glm::uvec2& sun, float radiance, float sky);

// The direction of a point (u, v) of a map: u = 0.5 is +X and grows towards +Z, v = 0 is +Y.
[[nodiscard]] glm::dvec3 mapDirection(const glm::dvec2& uv);
[[nodiscard]] glm::dvec2 mapPoint(const glm::dvec3& direction);

// A lookup, bilinear between texel centres, wrapped around in u and clamped in v.
[[nodiscard]] glm::dvec3 mapLookup(const Image& map, const glm::dvec2& uv);

} // namespace lavalight::test
