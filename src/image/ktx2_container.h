// KTX 2.0, the container of textures for graphics cards: what is where in a file.
// Source: Khronos, "KTX File Format Specification", version 2.0; names of fields are its names.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lavalight {

// How the texels of the largest level are stored.
enum class Ktx2Coding : uint8_t {
    plain, // texels of a format that Vulkan numbers
    etc1s, // Basis Universal, with codebooks in the global data (BasisLZ)
    uastc, // Basis Universal, blocks of 4x4 texels in 16 bytes each
};

// Views of a file's bytes, all of them within the file.
struct Ktx2File {
    Ktx2Coding coding = Ktx2Coding::plain;
    uint32_t formatNumber = 0; // vkFormat
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t levelCount = 0;
    bool isZstandard = false;                          // the level is compressed once more
    std::string_view level;                            // the largest one
    uint64_t levelBytes = 0;                           // of the level once decompressed
    std::string_view globalData;                       // of etc1s
    std::array<uint8_t, 2> channels{};                 // of the format descriptor's first two samples
    uint32_t sampleCount = 0;                          // of the format descriptor
    std::array<char, 4> swizzle{{'r', 'g', 'b', 'a'}}; // which of "rgba01" a texel's channels show
};

// Whether bytes begin as a KTX 2.0 file does.
[[nodiscard]] bool isKtx2(std::string_view bytes);

// Reads the header and what it points to. Throws Error, which does not name the file, for damaged files, for
// textures that are not one flat picture, and for codings that glTF does not have.
[[nodiscard]] Ktx2File readKtx2(std::string_view bytes);

} // namespace lavalight
