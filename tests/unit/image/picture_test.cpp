// Tests of decoding pictures: what must not reach the libraries, and what must not be taken for damage.
#include "image/picture.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "image/png.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

std::string errorOf(const std::string& bytes) {
    try {
        (void)decodePicture(bytes);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

void expectError(const std::string& bytes, const std::string& text) {
    const std::string error = errorOf(bytes);
    EXPECT_NE(error.find(text), std::string::npos) << "got: \"" << error << "\", wanted: " << text;
}

std::string bigEndian(uint32_t value, unsigned size) {
    std::string bytes;
    for (unsigned i = size; i-- > 0;)
        bytes += static_cast<char>(value >> (8 * i) & 0xFFu);
    return bytes;
}

// --- PNG ---

// Signature and header, a chunk without its checksum's truth, which stb does not ask for.
std::string pngHeader(uint32_t width, uint32_t height, int bits, int color) {
    std::string header = "IHDR" + bigEndian(width, 4) + bigEndian(height, 4);
    header += {static_cast<char>(bits), static_cast<char>(color), 0, 0, 0};
    return "\x89PNG\r\n\x1A\n" + bigEndian(13, 4) + header + bigEndian(0, 4);
}

TEST(Picture, PngThatClaimsMoreTexelsThanItsBytesCanHoldIsRefusedByItsHeader) {
    const std::string kDataChunk("\0\0\0\x37IDAT", 8); // stb 2.30 reads this far for the size
    expectError(pngHeader(60000, 60000, 8, 2) + kDataChunk + std::string(59, '\0'),
                "it has 60000 x 60000 texels, at most 134217728 are supported");
    expectError(pngHeader(11000, 11000, 8, 2) + kDataChunk + std::string(59, '\0'),
                "it is damaged: 11000 x 11000 texels cannot be in 100 bytes");
    expectError(pngHeader(1000, 1000, 1, 0) + kDataChunk + std::string(59, '\0'),
                "texels cannot be in 100 bytes");
    expectError(pngHeader(500, 500, 1, 0) + kDataChunk + std::string(59, '\0'), "it is damaged (");
    expectError(pngHeader(0x7FFFFFFF, 0x7FFFFFFF, 16, 6), "it has 2147483647 x 2147483647 texels");
}

TEST(Picture, PngOfOneColorIsNoBomb) {
    const TemporaryFolder folder;
    constexpr uint32_t kSide = 2048;
    writePng(folder / "white.png", kSide, kSide, std::vector<uint32_t>(kSide * kSide, 0xFFFFFFFFu));
    const std::string bytes = readFile(folder / "white.png");
    EXPECT_GT(kSide * kSide / bytes.size(), 25u); // texels a byte
    EXPECT_EQ(decodePicture(bytes).width, kSide);
}

// --- others ---

TEST(Picture, OtherFormatsThatTheLibraryKnowsAreNotDecoded) {
    const std::string gif =
        "GIF89a" +
        std::string("\x01\0\x01\0\x80\0\0\0\0\0\xFF\xFF\xFF,\0\0\0\0\x01\0\x01\0\0\x02\x02\x44\x01\0;", 29);
    expectError(gif, "it is not a PNG, JPEG, WebP or KTX2 file");
    expectError("P6 1 1 255\n123", "it is not a PNG, JPEG, WebP or KTX2 file");
    expectError("", "it is not a PNG, JPEG, WebP or KTX2 file");
    expectError("RIFF\x04", "not a PNG, JPEG, WebP or KTX2");
    expectError(std::string("RIFF\x04\0\0\0WEBP", 12), "it is a damaged WebP file");
}

} // namespace
} // namespace lavalight::test
