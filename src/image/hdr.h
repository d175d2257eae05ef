// Radiance HDR files (.hdr, .pic).
#pragma once

#include <filesystem>

#include "image/image.h"

namespace lavalight {

// Reads RGBE pixels, plain or run-length encoded in the old or the new way, rows from the top or from the
// bottom; EXPOSURE is undone, so that values are those of the scene. Throws Error for whatever is no such
// file: missing, damaged, incomplete, larger than kMaxImageSide, XYZE, or stored by columns. (stb's reader
// takes a file that ends early for one that ends in black.)
[[nodiscard]] Image readHdr(const std::filesystem::path& path);

} // namespace lavalight
