// Radiance HDR files (.hdr, .pic).
#pragma once

#include <cstdint>
#include <filesystem>

#include "image/image.h"
#include "image/pixel_limit.h"

namespace lavalight {

// Reads RGBE pixels, plain or run-length encoded in the old or the new way, rows from the top or from the
// bottom; EXPOSURE and COLORCORR are undone, so that values are those of the scene. Throws Error for whatever
// is no such file: missing, damaged, incomplete, larger than kMaxImageSide a side, than `mostPixels` or than
// memory, XYZE, or stored by columns. (stb's reader takes a file that ends early for one that ends in black.)
[[nodiscard]] Image readHdr(const std::filesystem::path& path, uint64_t mostPixels = kMaxImagePixels);

} // namespace lavalight
