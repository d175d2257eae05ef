// JPEG by the TurboJPEG API, which keeps libjpeg's jumps out of C++.
#include "image/jpeg.h"

#include <memory>
#include <new>
#include <string>

#include <fmt/format.h>
#include <turbojpeg.h>

#include "base/error.h"
#include "image/picture_limits.h"

namespace lavalight {
namespace {

constexpr int kChannels = 4; // RGBA, and CMYK

// Every block of 8 x 8 takes one bit of a JPEG, if only in the first scan of a progressive one.
constexpr uint64_t kMostTexelsPerByte = 8 * 64;

struct DecoderDeleter {
    void operator()(void* decoder) const { tjDestroy(decoder); }
};
using Decoder = std::unique_ptr<void, DecoderDeleter>;

Decoder makeDecoder() {
    Decoder decoder(tjInitDecompress());
    if (!decoder)
        throw std::bad_alloc();
    return decoder;
}

const unsigned char* dataOf(std::string_view bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

// A message of the library without the name of its function, which some begin with.
std::string messageOf(const Decoder& decoder) {
    const std::string message = tjGetErrorStr2(decoder.get());
    const size_t colon = message.find("(): ");
    return colon == std::string::npos ? message : message.substr(colon + 4);
}

struct Header {
    int width = 0;
    int height = 0;
    bool hasInks = false; // CMYK or YCCK
};

Header readHeader(const Decoder& decoder, std::string_view bytes) {
    Header header;
    int subsampling = 0;
    int colorspace = 0;
    const int result = tjDecompressHeader3(decoder.get(), dataOf(bytes), bytes.size(), &header.width,
                                           &header.height, &subsampling, &colorspace);
    // It fails as well, with the size set, on a warning and for subsampling that it has no name for; both are
    // decoded. It succeeds, with no size, for a file of nothing but tables.
    if (header.width < 1)
        throw Error(
            fmt::format("it is damaged ({})", result == 0 ? "it has no picture" : messageOf(decoder)));
    requirePictureFits(header.width, header.height);
    requirePlausible(header.width, header.height, bytes.size(), kMostTexelsPerByte);
    header.hasInks = colorspace == TJCS_CMYK || colorspace == TJCS_YCCK;
    return header;
}

// Light that inverted inks leave: each colour's times black's, in 255ths, rounded.
void replaceInks(std::vector<uint8_t>& texels) {
    for (size_t i = 0; i < texels.size(); i += kChannels) {
        const uint32_t black = texels[i + 3];
        for (size_t channel = 0; channel < 3; ++channel)
            texels[i + channel] = static_cast<uint8_t>((texels[i + channel] * black + 127) / 255);
        texels[i + 3] = 255;
    }
}

} // namespace

bool isJpeg(std::string_view bytes) {
    return bytes.starts_with("\xFF\xD8");
}

PictureSize measureJpeg(std::string_view bytes) {
    const Header header = readHeader(makeDecoder(), bytes);
    return {static_cast<uint32_t>(header.width), static_cast<uint32_t>(header.height), false};
}

Picture decodeJpeg(std::string_view bytes) {
    const Decoder decoder = makeDecoder();
    const Header header = readHeader(decoder, bytes);
    Picture picture;
    picture.width = static_cast<uint32_t>(header.width);
    picture.height = static_cast<uint32_t>(header.height);
    picture.bytes.resize(size_t{picture.width} * picture.height * kChannels);
    // Scans are limited (to 500) because each passes over all texels, however few bytes it has.
    const int result =
        tjDecompress2(decoder.get(), dataOf(bytes), bytes.size(), picture.bytes.data(), header.width,
                      header.width * kChannels, header.height, header.hasInks ? TJPF_CMYK : TJPF_RGBA,
                      TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS);
    if (result != 0 && tjGetErrorCode(decoder.get()) != TJERR_WARNING)
        throw Error(fmt::format("it is damaged ({})", messageOf(decoder)));
    if (result != 0)
        picture.damage = messageOf(decoder);
    if (header.hasInks)
        replaceInks(picture.bytes);
    return picture;
}

} // namespace lavalight
