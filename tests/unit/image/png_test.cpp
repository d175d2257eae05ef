// PNG files hold the pixels that they are given.
#include "image/png.h"

#include <memory>
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

TEST(WritePng, PixelsComeBackInPlaceWithoutTheirHighestByte) {
    const TemporaryFolder folder;
    const std::vector<uint32_t> written{0xff030201, 0xff000000, 0xffffffff,
                                        0x000000ff, 0x0000ff00, 0x00ff0000};
    writePng(folder / "image.png", 3, 2, written);
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<unsigned char, FreeImage> pixels(
        stbi_load((folder / "image.png").c_str(), &width, &height, &channels, 0));
    ASSERT_NE(pixels, nullptr);
    EXPECT_EQ(width, 3);
    EXPECT_EQ(height, 2);
    ASSERT_EQ(channels, 3);
    const std::vector<unsigned char> bytes(pixels.get(), pixels.get() + 18);
    EXPECT_EQ(bytes, (std::vector<unsigned char>{1, 2, 3, 0, 0, 0, 255, 255, 255, //
                                                 255, 0, 0, 0, 255, 0, 0, 0, 255}));
    EXPECT_EQ(folder.count(), 1);
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
