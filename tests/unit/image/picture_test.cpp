// Tests of decoding pictures: what must not reach the libraries, and what must not be taken for damage.
#include "image/picture.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "image/jpeg_check.h"
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
    expectError(pngHeader(60000, 60000, 8, 2) + std::string(67, '\0'),
                "it has 60000 x 60000 texels, at most 134217728 are supported");
    expectError(pngHeader(11000, 11000, 8, 2) + std::string(67, '\0'),
                "it is damaged: 11000 x 11000 texels cannot be in 100 bytes");
    expectError(pngHeader(1000, 1000, 1, 0) + std::string(67, '\0'), "texels cannot be in 100 bytes");
    expectError(pngHeader(500, 500, 1, 0) + std::string(67, '\0'), "it is damaged (");
    expectError(pngHeader(0x7FFFFFFF, 0x7FFFFFFF, 16, 6), "it has 2147483647 x 2147483647 texels");
}

TEST(Picture, PngOfOneColorIsNoBomb) {
    const TemporaryFolder folder;
    constexpr uint32_t kSide = 2048;
    writePng(folder / "white.png", kSide, kSide, std::vector<uint32_t>(kSide * kSide, 0xFFFFFFu));
    const std::string bytes = readFile(folder / "white.png");
    EXPECT_GT(kSide * kSide / bytes.size(), 25u); // texels a byte
    EXPECT_EQ(decodePicture(bytes).width, kSide);
}

// --- JPEG ---

std::string segment(uint8_t marker, const std::string& content) {
    std::string bytes{'\xFF', static_cast<char>(marker)};
    bytes += bigEndian(static_cast<uint32_t>(content.size() + 2), 2);
    return bytes += content;
}

// A Huffman table of `codes` codes of 16 lengths, which are spread as evenly as may be.
std::string huffmanTable(size_t codes) {
    std::string table(1, '\0');
    for (size_t i = 0; i < 16; ++i)
        table += static_cast<char>(codes / 16 + (i < codes % 16 ? 1 : 0));
    return table + std::string(codes, '\x01');
}

const std::string kStart = "\xFF\xD8";

TEST(Picture, JpegOfMoreHuffmanCodesThanTheDecoderHoldsIsRefused) {
    expectError(kStart + segment(0xC4, huffmanTable(257)), "a Huffman table of 257 codes, at most 256");
    expectError(kStart + segment(0xC4, huffmanTable(4080)), "a Huffman table of 4080 codes");
    expectError(kStart + segment(0xC4, huffmanTable(12) + huffmanTable(300)), "a Huffman table of 300 codes");
    expectError(kStart + segment(0xE0, "JFIF") + "padding\xFF" + segment(0xC4, huffmanTable(300)),
                "300 codes");
    const std::string cut = segment(0xC4, huffmanTable(300));
    expectError(kStart + cut.substr(0, 21), "300 codes"); // before the codes themselves
}

TEST(Picture, TablesAfterAScanAreSeenAndBytesOfOtherSegmentsAreNot) {
    const std::string bad = segment(0xC4, huffmanTable(300));
    const std::string scan =
        segment(0xDA, std::string(10, '\0')) + "data\xFF" + std::string(1, '\0') + "\xFF\xD3";
    EXPECT_THROW(requireSoundJpeg(kStart + scan + bad), Error);
    EXPECT_NO_THROW(requireSoundJpeg(kStart + segment(0xE1, bad) + "\xFF\xD9"));
    EXPECT_NO_THROW(requireSoundJpeg(kStart + "\xFF\xD9" + bad)); // behind the end
    EXPECT_NO_THROW(requireSoundJpeg(kStart + segment(0xC4, huffmanTable(256)) + scan));
}

TEST(Picture, JpegThatClaimsMoreTexelsThanItsBytesCanHoldIsRefusedByItsHeader) {
    const std::string frame = std::string("\x08", 1) + bigEndian(10000, 2) + bigEndian(10000, 2) +
                              std::string("\x03\x01\x11\x00\x02\x11\x00\x03\x11\x00", 10);
    expectError(kStart + segment(0xC0, frame), "10000 x 10000 texels cannot be in 21 bytes");
}

// --- others ---

TEST(Picture, OtherFormatsThatTheLibraryKnowsAreNotDecoded) {
    const std::string gif =
        "GIF89a" +
        std::string("\x01\0\x01\0\x80\0\0\0\0\0\xFF\xFF\xFF,\0\0\0\0\x01\0\x01\0\0\x02\x02\x44\x01\0;", 29);
    expectError(gif, "it is no PNG, JPEG or WebP file");
    expectError("P6 1 1 255\n123", "it is no PNG, JPEG or WebP file");
    expectError("", "it is no PNG, JPEG or WebP file");
    expectError("RIFF\x04\x00\x00\x00WEBP", "no PNG, JPEG or WebP"); // cut by the zero
    expectError(std::string("RIFF\x04\0\0\0WEBP", 12), "it is a damaged WebP file");
}

} // namespace
} // namespace lavalight::test
