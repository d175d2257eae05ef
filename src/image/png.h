// PNG files for people to look at: sRGB, 8 bit.
#pragma once

#include <cstdint>
#include <filesystem>

#include "image/image.h"

namespace lavalight {

// The sRGB transfer function of a linear value in [0, 1] (IEC 61966-2-1:1999): linear near black, a power
// above.
[[nodiscard]] float srgbFromLinear(float linear);

// The 8-bit sRGB code of a linear value: clamped to [0, 1], rounded to nearest; NaN is black.
[[nodiscard]] uint8_t srgbCode(float linear);

// Writes the image times 2^exposureStops, all or nothing (base/file.h). Equal input gives equal bytes. Throws
// Error.
void writePng(const std::filesystem::path& path, const Image& image, float exposureStops);

} // namespace lavalight
