#include "image/png.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>
#include <stb_image_write.h>
#include <zlib.h>

#include "base/error.h"
#include "base/file.h"
#include "image/image.h"

namespace lavalight {
namespace {

// stb counts bytes in ints, and doubles them as its output grows.
constexpr int64_t kMostBytes = INT32_MAX / 2;
static_assert(int64_t{kMaxImageSide} * (int64_t{kMaxImageSide} * 3 + 1) < kMostBytes);

std::vector<uint8_t> bytesOf(std::span<const uint32_t> pixels, int channels) {
    std::vector<uint8_t> bytes;
    bytes.reserve(pixels.size() * static_cast<size_t>(channels));
    for (const uint32_t pixel : pixels)
        for (int channel = 0; channel < channels; ++channel)
            bytes.push_back(static_cast<uint8_t>(pixel >> (8 * channel)));
    return bytes;
}

void appendTo(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<size_t>(size));
}

std::string bigEndian(uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<char>(value >> shift & 0xffu));
    return bytes;
}

// A chunk tEXt (PNG Specification, third edition, 11.3.3.2).
std::string textChunk(const std::string& keyword, const std::string& text) {
    const std::string data = "tEXt" + keyword + '\0' + text;
    const auto* bytes = reinterpret_cast<const Bytef*>(data.data());
    return bigEndian(static_cast<uint32_t>(data.size() - 4)) + data +
           bigEndian(static_cast<uint32_t>(crc32(0, bytes, static_cast<uInt>(data.size()))));
}

// Signature, and the chunk IHDR of 13 bytes with its length, name and checksum.
constexpr size_t kHeaderBytes = 8 + 25;

} // namespace

void requirePngFits(uint32_t width, uint32_t height, bool hasAlpha) {
    const int channels = hasAlpha ? 4 : 3;
    if (int64_t{height} * (int64_t{width} * channels + 1) > kMostBytes)
        throw Error(
            fmt::format("cannot write a PNG of {} x {} pixels with alpha: it is too large; try an EXR, or a "
                        "--background without alpha",
                        width, height));
}

std::string encodePng(uint32_t width, uint32_t height, std::span<const uint32_t> pixels,
                      const PngTexts& texts) {
    assert(width > 0 && height > 0 && width <= kMaxImageSide && height <= kMaxImageSide);
    assert(pixels.size() == size_t{width} * height);
    const bool isOpaque =
        std::all_of(pixels.begin(), pixels.end(), [](uint32_t pixel) { return pixel >> 24 == 0xffu; });
    const int channels = isOpaque ? 3 : 4;
    requirePngFits(width, height, !isOpaque);
    const std::vector<uint8_t> bytes = bytesOf(pixels, channels);
    const auto columns = static_cast<int>(width);
    const auto rows = static_cast<int>(height);
    std::string encoded;
    if (stbi_write_png_to_func(appendTo, &encoded, columns, rows, channels, bytes.data(),
                               columns * channels) == 0)
        throw Error(fmt::format("{} x {} pixels do not fit into memory", width, height));
    std::string chunks;
    for (const auto& [keyword, text] : texts)
        chunks += textChunk(keyword, text);
    encoded.insert(kHeaderBytes, chunks);
    return encoded;
}

void writePng(const std::filesystem::path& path, uint32_t width, uint32_t height,
              std::span<const uint32_t> pixels, const PngTexts& texts) {
    writeFileAtomically(path, encodePng(width, height, pixels, texts));
}

} // namespace lavalight
