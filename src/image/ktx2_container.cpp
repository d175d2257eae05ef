#include "image/ktx2_container.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "image/picture_limits.h"

namespace lavalight {
namespace {

constexpr std::string_view kIdentifier = "\xABKTX 20\xBB\r\n\x1A\n";
constexpr size_t kHeaderBytes = 80;
constexpr size_t kLevelBytes = 24; // an entry of the level index

// Values of supercompressionScheme.
constexpr uint32_t kNoScheme = 0;
constexpr uint32_t kBasisLz = 1;
constexpr uint32_t kZstandard = 2;

// Colour models of the Khronos Data Format Specification.
constexpr uint8_t kModelEtc1s = 163;
constexpr uint8_t kModelUastc = 166;

// Little-endian numbers of a file, and views of it; Error where they end behind it.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    [[nodiscard]] std::string_view view(uint64_t offset, uint64_t length, std::string_view what) const {
        if (offset > bytes_.size() || length > bytes_.size() - offset)
            throw Error(fmt::format("it is damaged: its {} ends behind the file", what));
        return bytes_.substr(offset, length);
    }
    [[nodiscard]] uint64_t number(size_t offset, size_t size) const {
        uint64_t value = 0;
        for (size_t i = size; i-- > 0;)
            value = value << 8u | static_cast<uint8_t>(bytes_.at(offset + i));
        return value;
    }
    [[nodiscard]] uint32_t word(size_t offset) const { return static_cast<uint32_t>(number(offset, 4)); }

  private:
    std::string_view bytes_;
};

void requireFlat(const Reader& header) {
    if (header.word(24) == 0 || header.word(28) != 0)
        throw Error("it is a KTX2 file of one or three dimensions; textures have two");
    if (header.word(32) > 1)
        throw Error("it is a KTX2 file of several layers; textures have one");
    if (header.word(36) != 1)
        throw Error("it is a KTX2 file of a cube map; textures are flat");
}

// The basic block of the format descriptor: 24 bytes after the descriptor's own size, then 16 a sample.
void readDescriptor(std::string_view bytes, Ktx2File& file, uint8_t& model) {
    const Reader descriptor(bytes);
    constexpr size_t kSamples = 28;
    if (bytes.size() < kSamples)
        throw Error("it is damaged: its format descriptor is cut short");
    model = static_cast<uint8_t>(descriptor.number(12, 1));
    file.sampleCount = static_cast<uint32_t>((bytes.size() - kSamples) / 16);
    for (size_t i = 0; i < std::min<size_t>(file.sampleCount, file.channels.size()); ++i)
        file.channels[i] = descriptor.number(kSamples + 16 * i + 3, 1) & 0xFu;
}

// The value of KTXswizzle among the pairs of keys and values, each with its length before it and filled to
// four bytes.
void readSwizzle(std::string_view pairs, Ktx2File& file) {
    constexpr std::string_view kKey("KTXswizzle\0", 11);
    while (pairs.size() > 4) {
        const uint32_t length = Reader(pairs).word(0);
        const std::string_view pair = pairs.substr(4, length);
        if (pair.starts_with(kKey) && pair.size() >= kKey.size() + 4) {
            const std::string_view value = pair.substr(kKey.size(), 4);
            if (value.find_first_not_of("rgba01") != std::string_view::npos)
                throw Error("it is damaged: its KTXswizzle has other letters than rgba01");
            std::copy(value.begin(), value.end(), file.swizzle.begin());
        }
        const uint64_t step = 4 + (uint64_t{length} + 3) / 4 * 4;
        pairs.remove_prefix(std::min<uint64_t>(step, pairs.size()));
    }
}

Ktx2Coding codingOf(uint32_t formatNumber, uint32_t scheme, uint8_t model) {
    constexpr uint32_t kUndefined = 0;
    if (formatNumber != kUndefined && (scheme == kNoScheme || scheme == kZstandard))
        return Ktx2Coding::plain;
    if (formatNumber == kUndefined && scheme == kBasisLz && model == kModelEtc1s)
        return Ktx2Coding::etc1s;
    if (formatNumber == kUndefined && (scheme == kNoScheme || scheme == kZstandard) && model == kModelUastc)
        return Ktx2Coding::uastc;
    throw Error(fmt::format("it is a KTX2 file of format {}, colour model {} and supercompression {}, which "
                            "glTF does not have; convert it to ETC1S or UASTC",
                            formatNumber, model, scheme));
}

} // namespace

bool isKtx2(std::string_view bytes) {
    return bytes.starts_with(kIdentifier);
}

Ktx2File readKtx2(std::string_view bytes) {
    const Reader reader(bytes);
    (void)reader.view(0, kHeaderBytes + kLevelBytes, "header");
    requireFlat(reader);
    Ktx2File file;
    file.formatNumber = reader.word(12);
    file.width = reader.word(20);
    file.height = reader.word(24);
    requirePictureFits(file.width, file.height);
    file.levelCount = std::max(reader.word(40), 1u);
    if (file.levelCount > 32)
        throw Error(fmt::format("it is damaged: it has {} levels", file.levelCount));
    uint8_t model = 0;
    readDescriptor(reader.view(reader.word(48), reader.word(52), "format descriptor"), file, model);
    readSwizzle(reader.view(reader.word(56), reader.word(60), "list of keys"), file);
    file.globalData = reader.view(reader.number(64, 8), reader.number(72, 8), "global data");
    const uint32_t scheme = reader.word(44);
    file.coding = codingOf(file.formatNumber, scheme, model);
    file.isZstandard = scheme == kZstandard;
    file.level = reader.view(reader.number(80, 8), reader.number(88, 8), "largest level");
    file.levelBytes = file.isZstandard ? reader.number(96, 8) : file.level.size();
    return file;
}

} // namespace lavalight
