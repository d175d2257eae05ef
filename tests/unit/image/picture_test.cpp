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

// A frame of 16 x 8 texels and one component, whose scans follow.
std::string frameOf(uint8_t marker) {
    return kStart + segment(marker, std::string("\x08\0\x08\0\x10\x01\x07\x11\0", 9));
}

const std::string kQuantisation = segment(0xDB, std::string(65, '\0'));
const std::string kHuffman = segment(0xC4, huffmanTable(12) + "\x10" + huffmanTable(12).substr(1));
const std::string kEnd = "\xFF\xD9";

// Of component 7 with tables 0: the first and the last coefficient, and the bits before.
std::string scanOf(int first, int last, int before, const std::string& data = "data") {
    std::string content{1, 7, 0};
    content += {static_cast<char>(first), static_cast<char>(last), static_cast<char>(before << 4)};
    return segment(0xDA, content) + data;
}

void expectUnsound(const std::string& jpeg, const std::string& text) {
    try {
        requireSoundJpeg(jpeg);
        ADD_FAILURE() << "was let through: " << text;
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
}

TEST(Picture, JpegIsDecodedOnlyWithTablesThatItDefines) {
    const std::string scan = scanOf(0, 63, 0) + kEnd;
    EXPECT_NO_THROW(requireSoundJpeg(frameOf(0xC0) + kQuantisation + kHuffman + scan));
    expectUnsound(frameOf(0xC0) + kQuantisation + scan, "a scan uses a Huffman table that is not there");
    expectUnsound(frameOf(0xC0) + kQuantisation + segment(0xC4, huffmanTable(12)) + scan, "Huffman table");
    expectUnsound(frameOf(0xC0) + kHuffman + scan, "a component uses a quantisation table that is not there");
    expectUnsound(frameOf(0xC0) + kQuantisation + scan + kHuffman, "Huffman table");
    // The first scan of a progressive one needs no table of the other coefficients.
    EXPECT_NO_THROW(requireSoundJpeg(frameOf(0xC2) + kQuantisation + segment(0xC4, huffmanTable(12)) +
                                     scanOf(0, 0, 0) + kEnd));
}

TEST(Picture, JpegWhoseComponentsAreNotAllSetIsRefused) {
    const std::string head = frameOf(0xC2) + kQuantisation + kHuffman;
    expectUnsound(head + kEnd, "a component has no scan");
    expectUnsound(head + scanOf(1, 63, 0) + scanOf(0, 0, 0) + kEnd, "a scan refines what no scan has begun");
    expectUnsound(head + scanOf(0, 0, 1) + kEnd, "a scan refines what no scan has begun");
    EXPECT_NO_THROW(requireSoundJpeg(head + scanOf(0, 0, 0) + scanOf(1, 63, 0) + scanOf(0, 0, 1) + kEnd));
}

TEST(Picture, JpegWhoseScanEndsBeforeItsLastRestartIsRefused) {
    const std::string head = frameOf(0xC0) + kQuantisation + kHuffman + segment(0xDD, std::string("\0\1", 2));
    expectUnsound(head + scanOf(0, 63, 0) + kEnd, "a scan ends before its last restart"); // two blocks
    EXPECT_NO_THROW(requireSoundJpeg(head + scanOf(0, 63, 0, "a\xFF\xD0z") + kEnd));
    const std::string none = segment(0xDD, std::string(2, '\0'));
    EXPECT_NO_THROW(requireSoundJpeg(head + none + scanOf(0, 63, 0) + kEnd));
}

TEST(Picture, JpegThatClaimsMoreTexelsThanItsBytesCanHoldIsRefusedByItsHeader) {
    const std::string frame = std::string("\x08", 1) + bigEndian(10000, 2) + bigEndian(10000, 2) +
                              std::string("\x03\x01\x11\x00\x02\x11\x00\x03\x11\x00", 10);
    const std::string tables = kQuantisation + kHuffman;
    const std::string scan = segment(0xDA, std::string("\x03\x01\0\x02\0\x03\0\0\x3F\0", 10));
    expectError(kStart + segment(0xC0, frame) + tables + scan, "10000 x 10000 texels cannot be in 166 bytes");
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
