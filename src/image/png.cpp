#include "image/png.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <stb_image_write.h>

#include "base/error.h"
#include "base/file.h"

namespace lavalight {
namespace {

constexpr int kChannels = 3;

// stb counts bytes in ints, and doubles them as its output grows.
static_assert(int64_t{kMaxImageSide} * (int64_t{kMaxImageSide} * kChannels + 1) < INT32_MAX / 2);

std::vector<uint8_t> encode(const Image& image, float scale) {
    std::vector<uint8_t> bytes;
    bytes.reserve(image.pixels.size() * kChannels);
    for (const glm::vec3& pixel : image.pixels)
        for (int c = 0; c < kChannels; ++c)
            bytes.push_back(srgbCode(pixel[c] * scale));
    return bytes;
}

void appendTo(void* stream, void* data, int size) {
    static_cast<std::ofstream*>(stream)->write(static_cast<const char*>(data), size);
}

} // namespace

float srgbFromLinear(float linear) {
    assert(linear >= 0.0f && linear <= 1.0f);
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

uint8_t srgbCode(float linear) {
    if (!(linear > 0.0f)) // NaN too
        return 0;
    return static_cast<uint8_t>(255.0f * srgbFromLinear(std::min(linear, 1.0f)) + 0.5f);
}

void writePng(const std::filesystem::path& path, const Image& image, float exposureStops) {
    assert(image.width > 0 && image.height > 0 && image.width <= kMaxImageSide &&
           image.height <= kMaxImageSide);
    const auto width = static_cast<int>(image.width);
    const auto height = static_cast<int>(image.height);
    const std::vector<uint8_t> bytes = encode(image, std::exp2(exposureStops));
    writeFileAtomically(path, [&](const std::filesystem::path& part) {
        std::ofstream out(part, std::ios::binary);
        if (!out)
            throw Error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
        const int encoded =
            stbi_write_png_to_func(appendTo, &out, width, height, kChannels, bytes.data(), width * kChannels);
        if (encoded == 0)
            throw Error(fmt::format("cannot write {}: {} x {} pixels do not fit into memory", path.string(),
                                    width, height));
        out.close();
        if (!out)
            throw Error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
    });
}

} // namespace lavalight
