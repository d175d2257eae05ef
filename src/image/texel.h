// Texels of pictures as numbers, and where coordinates lead: what shaders/lib/texture_filter.glsl is to the
// kernels.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "image/picture.h"

namespace lavalight {

enum class Wrap : uint32_t { repeat, mirror, clamp };

// RGBA in [0, 1]; x < width, y < height. isSrgb: the colour channels are decoded to linear ones (IEC
// 61966-2-1).
[[nodiscard]] glm::dvec4 texelOf(const Picture& picture, uint32_t x, uint32_t y, bool isSrgb);

// Column or row within the picture of texel i, counted on over its borders.
[[nodiscard]] uint32_t wrapTexel(int64_t i, uint32_t size, Wrap wrap);

} // namespace lavalight
