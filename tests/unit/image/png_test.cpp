// PNG files hold the pixels that they are given.
#include "image/png.h"

#include <array>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <stb_image.h>

#include "base/error.h"
#include "base/file.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::TemporaryFolder;

struct FreeImage {
    void operator()(unsigned char* pixels) const { stbi_image_free(pixels); }
};

// What a decoder finds in a file.
struct Decoded {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<unsigned char> bytes;
};

Decoded decode(const std::string& file) {
    Decoded image;
    const std::unique_ptr<unsigned char, FreeImage> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), static_cast<int>(file.size()),
                              &image.width, &image.height, &image.channels, 0));
    if (pixels)
        image.bytes.assign(pixels.get(), pixels.get() + static_cast<ptrdiff_t>(image.width) * image.height *
                                                            image.channels);
    return image;
}

TEST(WritePng, PixelsComeBackInPlaceWithoutAlphaWhereAllIsOpaque) {
    const TemporaryFolder folder;
    const std::vector<uint32_t> written{0xff030201, 0xff000000, 0xffffffff,
                                        0xff0000ff, 0xff00ff00, 0xffff0000};
    writePng(folder / "image.png", 3, 2, written);
    const Decoded image = decode(readFile(folder / "image.png"));
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    ASSERT_EQ(image.channels, 3);
    EXPECT_EQ(image.bytes, (std::vector<unsigned char>{1, 2, 3, 0, 0, 0, 255, 255, 255, //
                                                       255, 0, 0, 0, 255, 0, 0, 0, 255}));
    EXPECT_EQ(folder.count(), 1);
}

TEST(WritePng, AlphaBelow255ComesBackAndSoDoTexts) {
    const std::vector<uint32_t> written{0x80030201, 0xff0000ff};
    const std::string file =
        encodePng(2, 1, written, {{"Software", "Lavalight"}, {"lavalight:exposure", "1.5"}});
    const Decoded image = decode(file);
    ASSERT_EQ(image.channels, 4);
    EXPECT_EQ(image.bytes, (std::vector<unsigned char>{1, 2, 3, 128, 255, 0, 0, 255}));
    // Length, type, keyword, 0 and text, and the CRC-32 that zlib's documentation and Python's zlib.crc32
    // give.
    const std::string chunk("\0\0\0\x12tEXtSoftware\0Lavalight", 4 + 4 + 18);
    ASSERT_NE(file.find(chunk), std::string::npos);
    EXPECT_EQ(file.substr(file.find(chunk) + chunk.size(), 4), std::string("\342\352\121\064", 4));
    EXPECT_NE(file.find(std::string("lavalight:exposure\0001.5", 22)), std::string::npos);
}

// The kinds suit each of the row filters; the last is noise, which takes several chunks.
TEST(WritePng, PicturesOfAnyKindComeBackAndFlatOnesAreSmall) {
    constexpr uint32_t kSide = 1024;
    std::mt19937 random(1);
    const std::array<std::function<uint32_t(uint32_t, uint32_t)>, 5> kinds = {
        [](uint32_t, uint32_t) { return 0x336699u; },
        [](uint32_t x, uint32_t) { return (x * 0x010203u) & 0xffffffu; },
        [](uint32_t, uint32_t y) { return (y * 0x030201u) & 0xffffffu; },
        [](uint32_t x, uint32_t y) { return ((x + y) / 2 * 0x010101u) & 0xffffffu; },
        [&](uint32_t, uint32_t) { return random() & 0xffffffu; }};
    std::vector<uint32_t> pixels(size_t{kSide} * kSide);
    std::vector<size_t> sizes;
    for (const int channels : {3, 4})
        for (const auto& kind : kinds) {
            std::vector<unsigned char> bytes;
            for (uint32_t i = 0; i < pixels.size(); ++i) {
                const uint32_t alpha = channels == 3 ? 0xffu : i % 255u;
                pixels[i] = kind(i % kSide, i / kSide) | alpha << 24;
                for (int channel = 0; channel < channels; ++channel)
                    bytes.push_back(static_cast<unsigned char>(pixels[i] >> (8 * channel)));
            }
            const std::string file = encodePng(kSide, kSide, pixels);
            const Decoded image = decode(file);
            EXPECT_EQ(image.channels, channels);
            EXPECT_TRUE(image.bytes == bytes) << channels << " channels";
            sizes.push_back(file.size());
        }
    for (size_t i = 0; i < 4; ++i)
        EXPECT_LT(sizes[i], 20'000u) << i;
    EXPECT_LT(sizes[4], 3'160'000u); // noise takes the bytes that it has
}

TEST(WritePng, AnUnwritablePathIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::vector<uint32_t> pixels(4);
    EXPECT_THROW(writePng(folder / "none" / "image.png", 2, 2, pixels), Error);
    EXPECT_THROW(writePng(folder.path(), 2, 2, pixels), Error);
    EXPECT_THROW(writePng("/proc/image.png", 2, 2, pixels), Error);
    EXPECT_EQ(folder.count(), 0);
}

} // namespace
} // namespace lavalight
