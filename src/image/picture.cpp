// Pictures by stb_image and libwebp.
#include "image/picture.h"

#include <limits>
#include <memory>

#include <fmt/format.h>
#include <stb_image.h>
#include <webp/decode.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr int kChannels = 4;

void requireFitting(int64_t width, int64_t height) {
    if (width < 1 || height < 1)
        throw Error("it has no texels");
    if (static_cast<uint64_t>(width) > kMostPictureTexels / static_cast<uint64_t>(height))
        throw Error(fmt::format("it has {} x {} texels, at most {} are supported: scale it down", width,
                                height, kMostPictureTexels));
}

// RIFF, four bytes of length, WEBP.
bool isWebp(std::string_view bytes) {
    return bytes.size() >= 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP";
}

Picture decodeWebp(std::string_view bytes) {
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    Picture picture;
    int width = 0;
    int height = 0;
    if (WebPGetInfo(data, bytes.size(), &width, &height) == 0)
        throw Error("it is a damaged WebP file");
    requireFitting(width, height);
    picture.width = static_cast<uint32_t>(width);
    picture.height = static_cast<uint32_t>(height);
    picture.bytes.resize(size_t{picture.width} * picture.height * kChannels);
    if (WebPDecodeRGBAInto(data, bytes.size(), picture.bytes.data(), picture.bytes.size(),
                           width * kChannels) == nullptr)
        throw Error("it is a damaged WebP file");
    return picture;
}

struct StbDeleter {
    void operator()(void* texels) const { stbi_image_free(texels); }
};

Picture decodeByStb(std::string_view bytes) {
    if (bytes.size() > static_cast<size_t>(std::numeric_limits<int>::max()))
        throw Error("it is larger than 2 GiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, length, &width, &height, &channels) == 0)
        throw Error(fmt::format("it is no PNG, JPEG or WebP file ({})", stbi_failure_reason()));
    requireFitting(width, height);
    Picture picture;
    picture.is16Bit = stbi_is_16_bit_from_memory(data, length) != 0;
    const std::unique_ptr<void, StbDeleter> texels(
        picture.is16Bit
            ? static_cast<void*>(
                  stbi_load_16_from_memory(data, length, &width, &height, &channels, kChannels))
            : static_cast<void*>(stbi_load_from_memory(data, length, &width, &height, &channels, kChannels)));
    if (!texels)
        throw Error(fmt::format("it is damaged ({})", stbi_failure_reason()));
    picture.width = static_cast<uint32_t>(width);
    picture.height = static_cast<uint32_t>(height);
    const size_t size = size_t{picture.width} * picture.height * kChannels * (picture.is16Bit ? 2 : 1);
    const auto* first = static_cast<const uint8_t*>(texels.get());
    picture.bytes.assign(first, first + size);
    return picture;
}

} // namespace

Picture decodePicture(std::string_view bytes) {
    return isWebp(bytes) ? decodeWebp(bytes) : decodeByStb(bytes);
}

} // namespace lavalight
