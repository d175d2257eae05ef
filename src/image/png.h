// PNG files for people to look at: sRGB, 8 bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lavalight {

// Keywords (1 to 79 printable Latin-1 characters) and texts.
using PngTexts = std::vector<std::pair<std::string, std::string>>;

// The bytes of a file of sRGB pixels, rows from the top, each R, G, B and straight alpha from its lowest byte
// up. The file has alpha where a pixel's is below 255. `texts`: keywords and values of text chunks. Sides of
// 1 to kMaxImageSide pixels. Equal input gives equal bytes. Throws Error if memory does not suffice.
[[nodiscard]] std::string encodePng(uint32_t width, uint32_t height, std::span<const uint32_t> pixels,
                                    const PngTexts& texts = {});

// Writes such a file, all or nothing (base/file.h). Throws Error.
void writePng(const std::filesystem::path& path, uint32_t width, uint32_t height,
              std::span<const uint32_t> pixels, const PngTexts& texts = {});

} // namespace lavalight
