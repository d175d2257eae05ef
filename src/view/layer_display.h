// Layers of an image as a display shows them, and what stands behind pictures that are partly transparent.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "image/rendering.h"

namespace lavalight {

// Pixels of the layer of a row of FILM_PLANES, as LivePicture has them. `layers` holds it and, where its
// means are over hits, the layer of these. `scale` multiplies radiance (2^exposure).
//
//     normal              n / 2 + 1/2, black where nothing was hit
//     depth               the nearest white, the farthest all but black, what was not hit black
//     position, signed    each component from its least value in the picture to its largest
//     one component       grey, from the least to the largest
//     three components    colours, clamped to [0, 1]; all but albedo are radiance
[[nodiscard]] std::vector<uint32_t> displayOf(const Rendering& layers, uint32_t row, float scale);

// Puts a chequered ground of two greys behind pixels of straight alpha, which are opaque from then on.
// The picture is `width` pixels wide and fills the window, which may have more pixels than it.
void putOnCheckerboard(std::span<uint32_t> pixels, uint32_t width, const glm::uvec2& window);

} // namespace lavalight
