// How large an image may be, asked of its header before its pixels are given memory.
#pragma once

#include <cstdint>

#include "image/image.h"

namespace lavalight {

// Pixels of an image of the longest sides.
inline constexpr uint64_t kMaxImagePixels = uint64_t{kMaxImageSide} * kMaxImageSide;

// Elements of a texel buffer on the devices that we know, so the most texels of a picture or a scene:
// maxTexelBufferElements.
inline constexpr uint64_t kMostTexels = 134'217'728;

// Throws Error, which names no file, for more pixels than `most`, and for pixels of so many bytes each that
// memory does not hold them.
void requirePixelsFit(uint64_t width, uint64_t height, uint64_t most, uint64_t bytesEach);

} // namespace lavalight
