#include "image/ktx2.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <zstd.h>

#include "base/error.h"
#include "image/basis_universal.h"
#include "image/ktx2_container.h"

namespace lavalight {
namespace {

// A format of plain texels, by its number in Vulkan.
struct PlainFormat {
    std::array<uint32_t, 2> formatNumbers; // UNORM and SRGB, equal where there is no second
    uint32_t channels;
    bool is16Bit;
    bool isBgr = false;
};

constexpr std::array<PlainFormat, 10> kPlainFormats = {{
    {{9, 15}, 1, false},        // R8
    {{16, 22}, 2, false},       // R8G8
    {{23, 29}, 3, false},       // R8G8B8
    {{30, 36}, 3, false, true}, // B8G8R8
    {{37, 43}, 4, false},       // R8G8B8A8
    {{44, 50}, 4, false, true}, // B8G8R8A8
    {{70, 70}, 1, true},        // R16
    {{77, 77}, 2, true},        // R16G16
    {{84, 84}, 3, true},        // R16G16B16
    {{91, 91}, 4, true},        // R16G16B16A16
}};

const PlainFormat& plainFormatOf(const Ktx2File& file) {
    for (const PlainFormat& format : kPlainFormats)
        if (format.formatNumbers[0] == file.formatNumber || format.formatNumbers[1] == file.formatNumber)
            return format;
    throw Error(
        fmt::format("it is a KTX2 file of Vulkan's format {}, which is not supported; those of 8 and 16 "
                    "bits a channel are, and ETC1S and UASTC",
                    file.formatNumber));
}

uint64_t blocksAcross(uint32_t texels) {
    return (uint64_t{texels} + 3) / 4;
}

// Bytes of the level as the header's size and format ask for; none: they are whatever the coder made.
std::optional<uint64_t> expectedBytes(const Ktx2File& file) {
    switch (file.coding) {
    case Ktx2Coding::plain: {
        const PlainFormat& format = plainFormatOf(file);
        return uint64_t{file.width} * file.height * format.channels * (format.is16Bit ? 2 : 1);
    }
    case Ktx2Coding::uastc:
        return blocksAcross(file.width) * blocksAcross(file.height) * 16;
    case Ktx2Coding::etc1s:
        return std::nullopt;
    }
    return std::nullopt;
}

Ktx2File readSound(std::string_view bytes) {
    Ktx2File file = readKtx2(bytes);
    const std::optional<uint64_t> wanted = expectedBytes(file);
    if (wanted && *wanted != file.levelBytes)
        throw Error(fmt::format("it is damaged: its {} x {} texels take {} bytes, and it has {}", file.width,
                                file.height, *wanted, file.levelBytes));
    if (file.coding != Ktx2Coding::plain)
        requireBasisUniversal();
    return file;
}

std::string decompress(const Ktx2File& file) {
    std::string bytes(file.levelBytes, '\0');
    const size_t got = ZSTD_decompress(bytes.data(), bytes.size(), file.level.data(), file.level.size());
    if (ZSTD_isError(got) != 0)
        throw Error(fmt::format("it is damaged: {}", ZSTD_getErrorName(got)));
    if (got != bytes.size())
        throw Error("it is damaged: its level decompresses to fewer bytes than it states");
    return bytes;
}

// Channels that a format lacks are 0, alpha is 1, as in Vulkan; the file's swizzle picks among them.
template <class Value>
void expand(std::string_view level, const PlainFormat& format, const std::array<char, 4>& swizzle,
            std::vector<uint8_t>& out) {
    constexpr Value kOne = static_cast<Value>(~Value{0});
    constexpr std::string_view kLetters = "rgba01";
    std::array<size_t, 4> source{};
    for (size_t i = 0; i < 4; ++i)
        source[i] = kLetters.find(swizzle[i]);
    const size_t texels = out.size() / (4 * sizeof(Value));
    for (size_t texel = 0; texel < texels; ++texel) {
        std::array<Value, 6> values{0, 0, 0, kOne, 0, kOne};
        for (size_t channel = 0; channel < format.channels; ++channel) {
            const size_t at = (texel * format.channels + channel) * sizeof(Value);
            Value value = 0;
            for (size_t byte = 0; byte < sizeof(Value); ++byte)
                value = static_cast<Value>(value | static_cast<uint8_t>(level[at + byte]) << (8 * byte));
            values[format.isBgr && channel < 3 ? 2 - channel : channel] = value;
        }
        std::array<Value, 4> shown{};
        std::transform(source.begin(), source.end(), shown.begin(), [&](size_t i) { return values[i]; });
        std::copy_n(reinterpret_cast<const uint8_t*>(shown.data()), sizeof shown,
                    out.data() + texel * sizeof shown);
    }
}

void decodePlain(const Ktx2File& file, Picture& picture) {
    const std::string decompressed = file.isZstandard ? decompress(file) : std::string();
    const std::string_view level = file.isZstandard ? decompressed : file.level;
    const PlainFormat& format = plainFormatOf(file);
    if (format.is16Bit)
        expand<uint16_t>(level, format, file.swizzle, picture.bytes);
    else
        expand<uint8_t>(level, format, file.swizzle, picture.bytes);
}

PictureSize sizeOf(const Ktx2File& file) {
    return {file.width, file.height, file.coding == Ktx2Coding::plain && plainFormatOf(file).is16Bit};
}

} // namespace

PictureSize measureKtx2(std::string_view bytes) {
    return sizeOf(readSound(bytes));
}

Picture decodeKtx2(std::string_view bytes) {
    const Ktx2File file = readSound(bytes);
    const PictureSize size = sizeOf(file);
    Picture picture{{}, size.width, size.height, size.is16Bit, std::vector<uint8_t>(size.bytes())};
    if (file.coding == Ktx2Coding::plain) {
        decodePlain(file, picture);
    } else if (file.coding == Ktx2Coding::etc1s) {
        transcodeEtc1s(file, picture.bytes);
    } else {
        const std::string decompressed = file.isZstandard ? decompress(file) : std::string();
        transcodeUastc(file, file.isZstandard ? decompressed : file.level, picture.bytes);
    }
    return picture;
}

} // namespace lavalight
