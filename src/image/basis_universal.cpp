#include "image/basis_universal.h"

#include "base/error.h"

#if LAVALIGHT_BASISU

#include <limits>

#include <fmt/format.h>
// The transcoder's headers are not ours to mend.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <basisu_transcoder.h>
#pragma GCC diagnostic pop

namespace lavalight {
namespace {

constexpr auto kTarget = basist::transcoder_texture_format::cTFRGBA32;

// Channels of the format descriptor by which alpha holds green, and blue and alpha are missing: ETC1S's
// second slice GGG, UASTC's RRRG.
constexpr uint8_t kEtc1sGreen = 4;
constexpr uint8_t kUastcRedGreen = 5;

void initialise() {
    static const bool isDone = (basist::basisu_transcoder_init(), true);
    (void)isDone;
}

uint32_t blocksAcross(uint32_t texels) {
    return (texels + 3) / 4;
}

const uint8_t* dataOf(std::string_view bytes) {
    return reinterpret_cast<const uint8_t*>(bytes.data());
}

uint32_t sizeOf(std::string_view bytes) {
    if (bytes.size() > std::numeric_limits<uint32_t>::max())
        throw Error("it is larger than 4 GiB");
    return static_cast<uint32_t>(bytes.size());
}

uint32_t numberAt(std::string_view bytes, size_t offset, size_t size) {
    uint32_t value = 0;
    for (size_t i = size; i-- > 0;)
        value = value << 8u | static_cast<uint8_t>(bytes.at(offset + i));
    return value;
}

// The global data of BasisLZ: codebooks that all levels share, and where the largest level's slices are.
struct Etc1sData {
    uint32_t endpointCount = 0;
    uint32_t selectorCount = 0;
    std::string_view endpoints;
    std::string_view selectors;
    std::string_view tables;
    uint32_t flags = 0;
    uint32_t colorOffset = 0;
    uint32_t colorLength = 0;
    uint32_t alphaOffset = 0;
    uint32_t alphaLength = 0; // 0: it has no second slice
};

Etc1sData readGlobalData(const Ktx2File& file) {
    constexpr size_t kHeader = 20;
    constexpr size_t kImage = 20; // of each level
    const std::string_view bytes = file.globalData;
    if (bytes.size() < kHeader + kImage * file.levelCount)
        throw Error("it is damaged: its global data is cut short");
    Etc1sData data;
    data.endpointCount = numberAt(bytes, 0, 2);
    data.selectorCount = numberAt(bytes, 2, 2);
    std::string_view rest = bytes.substr(kHeader + kImage * file.levelCount);
    const auto take = [&](size_t lengthAt) {
        const uint32_t length = numberAt(bytes, lengthAt, 4);
        if (length > rest.size())
            throw Error("it is damaged: its codebooks are cut short");
        const std::string_view part = rest.substr(0, length);
        rest.remove_prefix(length);
        return part;
    };
    data.endpoints = take(4);
    data.selectors = take(8);
    data.tables = take(12);
    data.flags = numberAt(bytes, kHeader, 4);
    data.colorOffset = numberAt(bytes, kHeader + 4, 4);
    data.colorLength = numberAt(bytes, kHeader + 8, 4);
    data.alphaOffset = numberAt(bytes, kHeader + 12, 4);
    data.alphaLength = numberAt(bytes, kHeader + 16, 4);
    return data;
}

bool isWithin(std::string_view level, uint32_t offset, uint32_t length) {
    return offset <= level.size() && length <= level.size() - offset;
}

void takeGreenFromAlpha(std::vector<uint8_t>& rgba) {
    for (size_t i = 0; i < rgba.size(); i += 4) {
        rgba[i + 1] = rgba[i + 3];
        rgba[i + 2] = 0;
        rgba[i + 3] = 255;
    }
}

} // namespace

bool hasBasisUniversal() {
    return true;
}

void requireBasisUniversal() {}

void transcodeEtc1s(const Ktx2File& file, std::vector<uint8_t>& rgba) {
    initialise();
    constexpr uint32_t kDependsOnOtherFrames = 2; // flag of a frame of a video
    const Etc1sData data = readGlobalData(file);
    if ((data.flags & kDependsOnOtherFrames) != 0)
        throw Error("it is a frame of a video; textures stand still");
    if (data.colorLength == 0 || !isWithin(file.level, data.colorOffset, data.colorLength) ||
        !isWithin(file.level, data.alphaOffset, data.alphaLength))
        throw Error("it is damaged: a slice ends behind its level");
    basist::basisu_lowlevel_etc1s_transcoder transcoder;
    if (!transcoder.decode_palettes(data.endpointCount, dataOf(data.endpoints), sizeOf(data.endpoints),
                                    data.selectorCount, dataOf(data.selectors), sizeOf(data.selectors)) ||
        !transcoder.decode_tables(dataOf(data.tables), sizeOf(data.tables)))
        throw Error("it is damaged: its codebooks cannot be read");
    if (!transcoder.transcode_image(kTarget, rgba.data(), file.width * file.height, dataOf(file.level),
                                    sizeOf(file.level), blocksAcross(file.width), blocksAcross(file.height),
                                    file.width, file.height, 0, data.colorOffset, data.colorLength,
                                    data.alphaOffset, data.alphaLength, 0, data.alphaLength != 0))
        throw Error("it is damaged: its ETC1S blocks cannot be read");
    if (data.alphaLength != 0 && file.sampleCount > 1 && file.channels[1] == kEtc1sGreen)
        takeGreenFromAlpha(rgba);
}

void transcodeUastc(const Ktx2File& file, std::string_view level, std::vector<uint8_t>& rgba) {
    initialise();
    basist::basisu_lowlevel_uastc_ldr_4x4_transcoder transcoder;
    if (!transcoder.transcode_image(kTarget, rgba.data(), file.width * file.height, dataOf(level),
                                    sizeOf(level), blocksAcross(file.width), blocksAcross(file.height),
                                    file.width, file.height, 0, 0, sizeOf(level), 0, true))
        throw Error("it is damaged: its UASTC blocks cannot be read");
    if (file.sampleCount > 0 && file.channels[0] == kUastcRedGreen)
        takeGreenFromAlpha(rgba);
}

} // namespace lavalight

#else

namespace lavalight {

bool hasBasisUniversal() {
    return false;
}

void requireBasisUniversal() {
    throw Error(
        "it is a KTX2 file of Basis Universal, which this program was built without; run tools/setup, "
        "configure and build again");
}

void transcodeEtc1s(const Ktx2File&, std::vector<uint8_t>&) {
    requireBasisUniversal();
}

void transcodeUastc(const Ktx2File&, std::string_view, std::vector<uint8_t>&) {
    requireBasisUniversal();
}

} // namespace lavalight

#endif
