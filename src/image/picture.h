// Pictures that textures are made of: decoding of PNG, JPEG, WebP and KTX2.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lavalight {

// Four channels RGBA, rows from the top, values as in the file.
struct Picture {
    std::string name; // file or name in the scene, for messages
    uint32_t width = 0;
    uint32_t height = 0;
    bool is16Bit = false;
    std::vector<uint8_t> bytes; // 4 or, in the machine's byte order, 8 a texel
    std::string damage{};       // what the decoder passed over; empty: nothing
};

struct PictureSize {
    uint32_t width = 0;
    uint32_t height = 0;
    bool is16Bit = false;

    [[nodiscard]] uint64_t bytes() const { return uint64_t{width} * height * (is16Bit ? 8 : 4); }
};

// The size of the picture that decodePicture would make. Throws Error, which does not name the picture, for
// other formats, for pictures of too many texels, and of more than their bytes can hold.
[[nodiscard]] PictureSize measurePicture(std::string_view bytes);

// "image/png", "image/jpeg", "image/webp" or "image/ktx2", by the first bytes; empty for anything else.
[[nodiscard]] std::string mediaTypeOf(std::string_view bytes);

// Decodes the bytes of a PNG, JPEG, WebP or KTX2 file, told apart by their first bytes. Grey becomes RGB, a
// missing alpha 1. Throws Error as measurePicture does, before anything is allocated, and for damaged bytes,
// unless a JPEG can be shown all the same.
[[nodiscard]] Picture decodePicture(std::string_view bytes);

} // namespace lavalight
