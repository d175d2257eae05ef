// Tests of KTX 2.0: plain texels, those of Basis Universal, and files that are damaged or hold something
// else.
#include "image/ktx2.h"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include "base/error.h"
#include "base/file.h"
#include "image/basis_universal.h"

namespace lavalight::test {
namespace {

std::string number(uint64_t value, size_t size) {
    std::string bytes;
    for (size_t i = 0; i < size; ++i)
        bytes += static_cast<char>(value >> (8 * i) & 0xFFu);
    return bytes;
}

// A file of one level, by default of two RGBA texels side by side.
struct Ktx2 {
    uint32_t formatNumber = 37;
    uint32_t width = 2;
    uint32_t height = 1;
    uint32_t depth = 0;
    uint32_t layers = 0;
    uint32_t faces = 1;
    uint32_t scheme = 0;
    uint8_t model = 1;
    uint8_t channel = 0;
    std::string level = "\x01\x02\x03\x04\x05\x06\x07\x08";
    uint64_t levelBytes = 8; // once decompressed
    uint64_t levelShift = 0; // by which the index names a wrong place
    std::string keys{};      // pairs of keys and values

    [[nodiscard]] std::string bytes() const {
        constexpr uint64_t kIndex = 80;
        const uint64_t descriptorAt = kIndex + 24;
        const std::string block = number(0, 4) + number(2, 2) + number(40, 2) + number(model, 1) +
                                  number(0, 15) + number(0, 3) + number(channel, 1) + number(0, 12);
        const std::string descriptor = number(block.size() + 4, 4) + block;
        const uint64_t keysAt = descriptorAt + descriptor.size();
        const uint64_t levelAt = keysAt + keys.size();
        std::string file = "\xABKTX 20\xBB\r\n\x1A\n";
        for (const uint32_t word : {formatNumber, 1u, width, height, depth, layers, faces, 1u, scheme})
            file += number(word, 4);
        file += number(descriptorAt, 4) + number(descriptor.size(), 4);
        file += number(keys.empty() ? 0 : keysAt, 4) + number(keys.size(), 4);
        file += number(0, 8) + number(0, 8);
        file += number(levelAt + levelShift, 8) + number(level.size(), 8) + number(levelBytes, 8);
        return file + descriptor + keys + level;
    }
    [[nodiscard]] Picture decode() const { return decodePicture(bytes()); }
    [[nodiscard]] std::string error() const {
        try {
            (void)decode();
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
};

using Texels = std::vector<uint8_t>;

TEST(Ktx2, PlainTexelsComeBackAsTheyWent) {
    const Picture picture = Ktx2{}.decode();
    EXPECT_EQ(picture.width, 2u);
    EXPECT_EQ(picture.height, 1u);
    EXPECT_FALSE(picture.is16Bit);
    EXPECT_EQ(picture.bytes, (Texels{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Ktx2, ZstandardIsUndone) {
    Ktx2 file{.scheme = 2};
    const std::string plain = file.level;
    file.level.resize(ZSTD_compressBound(plain.size()));
    file.level.resize(ZSTD_compress(file.level.data(), file.level.size(), plain.data(), plain.size(), 3));
    EXPECT_EQ(file.decode().bytes, (Texels{1, 2, 3, 4, 5, 6, 7, 8}));
    file.level.back() = static_cast<char>(file.level.back() ^ 1);
    file.level.resize(file.level.size() - 2);
    EXPECT_NE(file.error().find("it is damaged"), std::string::npos) << file.error();
}

TEST(Ktx2, ChannelsThatAFormatLacksAreBlackAndOpaque) {
    const Ktx2 file{.formatNumber = 16, .level = "\x01\x02\x03\x04", .levelBytes = 4};
    EXPECT_EQ(file.decode().bytes, (Texels{1, 2, 0, 255, 3, 4, 0, 255}));
}

TEST(Ktx2, BlueFirstIsPutRight) {
    const Ktx2 file{.formatNumber = 36, .level = "\x01\x02\x03\x04\x05\x06", .levelBytes = 6};
    EXPECT_EQ(file.decode().bytes, (Texels{3, 2, 1, 255, 6, 5, 4, 255}));
}

TEST(Ktx2, SixteenBitsStaySixteen) {
    const Ktx2 file{.formatNumber = 70, .level = "\x01\x02\x03\x04", .levelBytes = 4};
    const Picture picture = file.decode();
    EXPECT_TRUE(picture.is16Bit);
    EXPECT_EQ(picture.bytes, (Texels{1, 2, 0, 0, 0, 0, 255, 255, 3, 4, 0, 0, 0, 0, 255, 255}));
}

TEST(Ktx2, ASwizzleMakesGreyOfOneChannel) {
    const std::string key("KTXswizzle\0rrr1\0", 16);
    const std::string other("KTXorientation\0rd\0", 18);
    const Ktx2 file{.formatNumber = 9,
                    .level = "\x07\x09",
                    .levelBytes = 2,
                    .keys = number(18, 4) + other + number(0, 2) + number(16, 4) + key};
    EXPECT_EQ(file.decode().bytes, (Texels{7, 7, 7, 255, 9, 9, 9, 255}));
}

TEST(Ktx2, FilesThatSayMoreThanTheyHoldAreRefused) {
    const auto expectDamaged = [](const Ktx2& file) {
        EXPECT_NE(file.error().find("it is damaged"), std::string::npos) << file.error();
    };
    expectDamaged({.width = 3});
    expectDamaged({.width = 1});
    expectDamaged({.levelShift = 1});
    expectDamaged({.levelShift = static_cast<uint64_t>(-300)});
    expectDamaged({.keys = number(15, 4) + std::string("KTXswizzle\0rgbx", 15) + number(0, 1)});
    const std::string whole = Ktx2{}.bytes();
    for (size_t length = 12; length < whole.size(); ++length)
        EXPECT_THROW((void)decodePicture(whole.substr(0, length)), Error) << length;
}

TEST(Ktx2, DescriptorsBeyondTheFileAreRefused) {
    std::string file = Ktx2{}.bytes();
    for (size_t at = 48; at < 52; ++at)
        file[at] = '\xFF';
    EXPECT_THROW((void)decodePicture(file), Error);
}

// Eight bytes from four before 2^64 end at four.
TEST(Ktx2, PlacesWhoseEndsWrapRoundAreRefused) {
    std::string file = Ktx2{}.bytes();
    file.replace(80, 8, number(static_cast<uint64_t>(-4), 8));
    EXPECT_THROW((void)decodePicture(file), Error);
}

TEST(Ktx2, WhatIsNoFlatPictureIsRefusedByItsKind) {
    EXPECT_NE((Ktx2{.depth = 2}.error().find("three dimensions")), std::string::npos);
    EXPECT_NE((Ktx2{.layers = 2}.error().find("several layers")), std::string::npos);
    EXPECT_NE((Ktx2{.faces = 6}.error().find("cube map")), std::string::npos);
    EXPECT_NE((Ktx2{.formatNumber = 145}.error().find("format 145")), std::string::npos);
    EXPECT_NE((Ktx2{.formatNumber = 0, .model = 162}.error().find("colour model 162")), std::string::npos);
    EXPECT_NE((Ktx2{.width = 60000, .height = 60000}.error().find("at most")), std::string::npos);
}

// A block of 4x4 equal texels: mode 8, whose code is 5 bits, then four channels.
std::string solidBlock(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha) {
    constexpr uint64_t kMode8 = 0x17;
    const uint64_t colors = red | green << 8u | blue << 16u | static_cast<uint64_t>(alpha) << 24u;
    std::string block = number(kMode8 | colors << 5u, 8);
    block.resize(16, '\0');
    return block;
}

TEST(Ktx2, UastcBlocksAreTranscoded) {
    if (!hasBasisUniversal())
        GTEST_SKIP() << "built without Basis Universal";
    const std::string level = solidBlock(200, 100, 50, 25) + solidBlock(1, 2, 3, 255);
    const Ktx2 file{.formatNumber = 0,
                    .width = 6,
                    .height = 3,
                    .model = 166,
                    .channel = 3,
                    .level = level,
                    .levelBytes = 32};
    const Picture picture = file.decode();
    ASSERT_EQ(picture.bytes.size(), 6u * 3 * 4);
    EXPECT_EQ(Texels(picture.bytes.begin(), picture.bytes.begin() + 4), (Texels{200, 100, 50, 25}));
    EXPECT_EQ(Texels(picture.bytes.end() - 4, picture.bytes.end()), (Texels{1, 2, 3, 255}));
}

TEST(Ktx2, GreenThatIsKeptInAlphaIsGreen) {
    if (!hasBasisUniversal())
        GTEST_SKIP() << "built without Basis Universal";
    const Ktx2 file{.formatNumber = 0,
                    .width = 4,
                    .height = 4,
                    .model = 166,
                    .channel = 5,
                    .level = solidBlock(200, 200, 200, 25),
                    .levelBytes = 16};
    const Picture picture = file.decode();
    EXPECT_EQ(Texels(picture.bytes.begin(), picture.bytes.begin() + 4), (Texels{200, 25, 0, 255}));
}

// Quarters of 4 x 4 texels, which are blocks: each has one colour, so that nothing but its rounding is lost.
TEST(Ktx2, FilesOfAnEncoderShowTheirColorsWhereTheyAre) {
    if (!hasBasisUniversal())
        GTEST_SKIP() << "built without Basis Universal";
    for (const char* name : {"etc1s.ktx2", "uastc.ktx2"}) {
        const std::string bytes = readFile(fmt::format("{}/tests/field/{}", LAVALIGHT_SOURCE_DIR, name));
        const Picture picture = decodePicture(bytes);
        ASSERT_EQ(picture.width, 8u) << name;
        ASSERT_EQ(picture.height, 8u) << name;
        const auto expectNear = [&](size_t x, size_t y, const Texels& color) {
            for (size_t i = 0; i < 4; ++i)
                EXPECT_NEAR(picture.bytes[4 * (8 * y + x) + i], color[i], 4) << name << " " << x << " " << y;
        };
        expectNear(0, 0, {255, 0, 0, 255});
        expectNear(3, 3, {255, 0, 0, 255});
        expectNear(7, 0, {0, 255, 0, 255});
        expectNear(0, 7, {0, 0, 255, 128});
        expectNear(7, 7, {255, 255, 255, 0});
    }
}

TEST(Ktx2, DamagedStreamsOfAnEncoderAreRefusedOrShown) {
    if (!hasBasisUniversal())
        GTEST_SKIP() << "built without Basis Universal";
    const std::string bytes = readFile(LAVALIGHT_SOURCE_DIR "/tests/field/etc1s.ktx2");
    for (size_t i = 80; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
        try {
            EXPECT_LE(decodePicture(damaged).bytes.size(), 256u);
        } catch (const Error&) {
            continue; // a message, which is all that it may be
        }
    }
}

// AddressSanitizer sees what the transcoder of its authors reads there.
TEST(Ktx2, ALoneLongCodeOfAHuffmanTableHasNoSiblingBehindTheTree) {
    const std::string bytes = readFile(LAVALIGHT_SOURCE_DIR "/tests/field/etc1s_long_code.ktx2");
    EXPECT_THROW((void)decodePicture(bytes), Error);
}

TEST(Ktx2, WithoutTheTranscoderTheMessageSaysHowToGetIt) {
    if (hasBasisUniversal())
        GTEST_SKIP() << "built with Basis Universal";
    const Ktx2 file{.formatNumber = 0,
                    .width = 4,
                    .height = 4,
                    .model = 166,
                    .level = solidBlock(1, 2, 3, 4),
                    .levelBytes = 16};
    EXPECT_NE(file.error().find("tools/setup"), std::string::npos) << file.error();
}

} // namespace
} // namespace lavalight::test
