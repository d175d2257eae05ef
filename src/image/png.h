// PNG files for people to look at: sRGB, 8 bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace lavalight {

// The bytes of a file of sRGB pixels, rows from the top, each R, G, B from its lowest byte up (the highest is
// left out). Sides of 1 to kMaxImageSide pixels. Equal input gives equal bytes. Throws Error if memory does
// not suffice.
[[nodiscard]] std::string encodePng(uint32_t width, uint32_t height, std::span<const uint32_t> pixels);

// Writes such a file, all or nothing (base/file.h). Throws Error.
void writePng(const std::filesystem::path& path, uint32_t width, uint32_t height,
              std::span<const uint32_t> pixels);

} // namespace lavalight
