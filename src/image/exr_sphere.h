// How an OpenEXR image lies around the sphere of all directions.
#pragma once

#include <cstdint>

#include <ImfForward.h>

#include "image/image.h"

namespace lavalight {

// Makes an equirectangular map of `image`, the pixels of a file's data window. By the header's attribute
// envmap they are such a map, or the six faces of a cube one below another, which are resampled. Without that
// attribute the display window is the map, black where there are no pixels: writers crop black borders.
// Throws Error, which names no file, for cubes whose faces are no squares, for windows that do not meet, and
// for maps of more than `mostPixels`.
[[nodiscard]] Image aroundSphere(Image image, const Imf::Header& header, uint64_t mostPixels);

} // namespace lavalight
