// Shadows that the ground caught (shaders/shared/shadow.h): from the means of a film's planes to alpha and
// colour.
#pragma once

#include <cstddef>
#include <optional>

#include <glm/glm.hpp>

#include "image/rendering.h"

namespace lavalight {

// The share of the light on the ground that something keeps from it. `shadow`: a pixel's mean of
// kShadowPlane.
[[nodiscard]] float shadowShare(const glm::vec3& shadow);
// The part of the pixel's alpha that is shadow.
[[nodiscard]] float shadowAlpha(const glm::vec3& shadow);

// Adds the shadows of some pixels to their coverage, and takes from colour, emission and direct light what
// they keep from the background. Layers are the means of their planes before; without kShadowPlane nothing
// changes.
void castShadows(Rendering& rendering, size_t firstPixel, size_t pixels);

// Coverage without shadows, which is what colour is associated with; none where there is no coverage.
[[nodiscard]] std::optional<Image> coverageWithoutShadow(const Rendering& rendering);

} // namespace lavalight
