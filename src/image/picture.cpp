// PNG by stb_image, WebP by libwebp; JPEG and KTX2 have files of their own.
#include "image/picture.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <stb_image.h>
#include <webp/decode.h>

#include "base/error.h"
#include "image/jpeg.h"
#include "image/ktx2.h"
#include "image/ktx2_container.h"
#include "image/picture_limits.h"

namespace lavalight {
namespace {

constexpr int kChannels = 4;

// A stream of deflate stands for at most 1032 times its bytes: 258 a match, whose two codes take a bit each.
constexpr uint64_t kMostDeflateExpansion = 1032;

bool isPng(std::string_view bytes) {
    return bytes.starts_with("\x89PNG\r\n\x1A\n");
}

// RIFF, four bytes of length, WEBP.
bool isWebp(std::string_view bytes) {
    return bytes.size() >= 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP";
}

// What the first chunk says, which starts at byte 8: length, "IHDR", width, height, bits of a channel, kind
// of colour.
struct PngHeader {
    uint32_t width = 0;
    uint32_t height = 0;
    uint64_t texelsPerByte = 1; // at most, of the whole file
};

std::optional<PngHeader> headerOfPng(std::string_view bytes) {
    if (!isPng(bytes) || bytes.size() < 26 || bytes.substr(12, 4) != "IHDR")
        return std::nullopt;
    const auto at = [&](size_t i) { return static_cast<uint8_t>(bytes[i]); };
    const auto word = [&](size_t i) {
        return uint32_t{at(i)} << 24u | uint32_t{at(i + 1)} << 16u | uint32_t{at(i + 2)} << 8u | at(i + 3);
    };
    const uint8_t color = at(25);
    const uint64_t channels = color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1;
    const uint64_t bits = std::max<uint64_t>(at(24) * channels, 1);
    return PngHeader{word(16), word(20), std::max<uint64_t>(8 * kMostDeflateExpansion / bits, 1)};
}

PictureSize measureWebp(std::string_view bytes) {
    WebPBitstreamFeatures features;
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
        throw Error("it is a damaged WebP file");
    if (features.has_animation != 0)
        throw Error("it is an animated WebP file, and textures stand still; save one of its frames");
    requirePictureFits(features.width, features.height);
    return {static_cast<uint32_t>(features.width), static_cast<uint32_t>(features.height), false};
}

Picture decodeWebp(std::string_view bytes) {
    const PictureSize size = measureWebp(bytes);
    Picture picture{{}, size.width, size.height, false, std::vector<uint8_t>(size.bytes())};
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    if (WebPDecodeRGBAInto(data, bytes.size(), picture.bytes.data(), picture.bytes.size(),
                           static_cast<int>(size.width) * kChannels) == nullptr)
        throw Error("it is a damaged WebP file");
    return picture;
}

PictureSize measurePng(std::string_view bytes) {
    if (bytes.size() > static_cast<size_t>(std::numeric_limits<int>::max()))
        throw Error("it is larger than 2 GiB");
    const std::optional<PngHeader> png = headerOfPng(bytes);
    if (png) // stb calls what is too large for it unknown
        requirePictureFits(png->width, png->height);
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, length, &width, &height, &channels) == 0)
        throw Error(fmt::format("it is damaged ({})", stbi_failure_reason()));
    requirePictureFits(width, height);
    requirePlausible(width, height, bytes.size(), png ? png->texelsPerByte : 8 * kMostDeflateExpansion);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height),
            stbi_is_16_bit_from_memory(data, length) != 0};
}

struct StbDeleter {
    void operator()(void* texels) const { stbi_image_free(texels); }
};

Picture decodePng(std::string_view bytes) {
    const PictureSize size = measurePng(bytes);
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<void, StbDeleter> texels(
        size.is16Bit
            ? static_cast<void*>(
                  stbi_load_16_from_memory(data, length, &width, &height, &channels, kChannels))
            : static_cast<void*>(stbi_load_from_memory(data, length, &width, &height, &channels, kChannels)));
    if (!texels)
        throw Error(fmt::format("it is damaged ({})", stbi_failure_reason()));
    const auto* first = static_cast<const uint8_t*>(texels.get());
    return {{}, size.width, size.height, size.is16Bit, std::vector<uint8_t>(first, first + size.bytes())};
}

struct Format {
    const char* mediaType;
    bool (*isOf)(std::string_view);
    PictureSize (*measure)(std::string_view);
    Picture (*decode)(std::string_view);
};
constexpr std::array<Format, 4> kFormats = {{{"image/png", isPng, measurePng, decodePng},
                                             {"image/jpeg", isJpeg, measureJpeg, decodeJpeg},
                                             {"image/webp", isWebp, measureWebp, decodeWebp},
                                             {"image/ktx2", isKtx2, measureKtx2, decodeKtx2}}};

// Null for anything else: stb reads more formats, which glTF does not have and nobody has tested.
const Format* findFormat(std::string_view bytes) {
    for (const Format& format : kFormats)
        if (format.isOf(bytes))
            return &format;
    return nullptr;
}

const Format& formatOf(std::string_view bytes) {
    if (const Format* format = findFormat(bytes))
        return *format;
    throw Error("it is not a PNG, JPEG, WebP or KTX2 file");
}

} // namespace

PictureSize measurePicture(std::string_view bytes) {
    return formatOf(bytes).measure(bytes);
}

std::string mediaTypeOf(std::string_view bytes) {
    const Format* format = findFormat(bytes);
    return format == nullptr ? std::string() : format->mediaType;
}

Picture decodePicture(std::string_view bytes) {
    return formatOf(bytes).decode(bytes);
}

} // namespace lavalight
