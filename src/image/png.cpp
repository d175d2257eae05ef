#include "image/png.h"

#include <cassert>
#include <vector>

#include <fmt/format.h>
#include <stb_image_write.h>

#include "base/error.h"
#include "base/file.h"
#include "image/image.h"

namespace lavalight {
namespace {

constexpr int kChannels = 3;

// stb counts bytes in ints, and doubles them as its output grows.
static_assert(int64_t{kMaxImageSide} * (int64_t{kMaxImageSide} * kChannels + 1) < INT32_MAX / 2);

std::vector<uint8_t> bytesOf(std::span<const uint32_t> pixels) {
    std::vector<uint8_t> bytes;
    bytes.reserve(pixels.size() * kChannels);
    for (const uint32_t pixel : pixels)
        for (int channel = 0; channel < kChannels; ++channel)
            bytes.push_back(static_cast<uint8_t>(pixel >> (8 * channel)));
    return bytes;
}

void appendTo(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<size_t>(size));
}

} // namespace

std::string encodePng(uint32_t width, uint32_t height, std::span<const uint32_t> pixels) {
    assert(width > 0 && height > 0 && width <= kMaxImageSide && height <= kMaxImageSide);
    assert(pixels.size() == size_t{width} * height);
    const std::vector<uint8_t> bytes = bytesOf(pixels);
    const auto columns = static_cast<int>(width);
    const auto rows = static_cast<int>(height);
    std::string encoded;
    if (stbi_write_png_to_func(appendTo, &encoded, columns, rows, kChannels, bytes.data(),
                               columns * kChannels) == 0)
        throw Error(fmt::format("{} x {} pixels do not fit into memory", width, height));
    return encoded;
}

void writePng(const std::filesystem::path& path, uint32_t width, uint32_t height,
              std::span<const uint32_t> pixels) {
    writeFileAtomically(path, encodePng(width, height, pixels));
}

} // namespace lavalight
