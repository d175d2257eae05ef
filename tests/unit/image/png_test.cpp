// PNG files hold the sRGB codes that the standard asks for.
#include "image/png.h"

#include <cmath>
#include <limits>
#include <memory>

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

TEST(SrgbFromLinear, MatchesTheStandardAtKnownPoints) {
    EXPECT_FLOAT_EQ(srgbFromLinear(0.0f), 0.0f);
    EXPECT_FLOAT_EQ(srgbFromLinear(0.001f), 0.01292f);      // the linear piece
    EXPECT_NEAR(srgbFromLinear(0.18f), 0.46135613f, 1e-6f); // 1.055 * 0.18^(1/2.4) - 0.055
    EXPECT_NEAR(srgbFromLinear(0.21404114f), 0.5f, 1e-6f);  // ((0.5 + 0.055) / 1.055)^2.4
    EXPECT_FLOAT_EQ(srgbFromLinear(1.0f), 1.0f);
}

TEST(SrgbFromLinear, ThePiecesMeet) {
    const float below = srgbFromLinear(0.0031308f);
    const float above = srgbFromLinear(std::nextafter(0.0031308f, 1.0f));
    EXPECT_NEAR(below, above, 1e-6f); // the standard's rounded constants leave a step of 3e-8
}

TEST(SrgbCode, EveryCodeSurvivesDecodingAndEncoding) {
    for (int code = 0; code < 256; ++code) {
        const double s = code / 255.0;
        const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        EXPECT_EQ(srgbCode(static_cast<float>(linear)), code);
    }
}

TEST(SrgbCode, WhatIsOutOfRangeIsClampedAndNanIsBlack) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(srgbCode(-1.0f), 0);
    EXPECT_EQ(srgbCode(-kInfinity), 0);
    EXPECT_EQ(srgbCode(7.0f), 255);
    EXPECT_EQ(srgbCode(kInfinity), 255);
    EXPECT_EQ(srgbCode(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(WritePng, PixelsComeBackInPlaceWithTheExposureApplied) {
    const TemporaryFolder folder;
    Image image(3, 2);
    image.pixels[0] = {0.25f, 0.5f, 1.0f};
    image.pixels[5] = {std::nanf(""), 100.0f, 0.0f};
    writePng(folder / "image.png", image, -1.0f);
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<unsigned char, FreeImage> pixels(
        stbi_load((folder / "image.png").c_str(), &width, &height, &channels, 0));
    ASSERT_NE(pixels, nullptr);
    EXPECT_EQ(width, 3);
    EXPECT_EQ(height, 2);
    ASSERT_EQ(channels, 3);
    EXPECT_EQ(pixels.get()[0], srgbCode(0.125f));
    EXPECT_EQ(pixels.get()[1], srgbCode(0.25f));
    EXPECT_EQ(pixels.get()[2], srgbCode(0.5f));
    EXPECT_EQ(pixels.get()[3], 0);
    EXPECT_EQ(pixels.get()[15], 0);
    EXPECT_EQ(pixels.get()[16], 255);
    EXPECT_EQ(folder.count(), 1);
}

TEST(WritePng, AnUnwritablePathIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    EXPECT_THROW(writePng(folder / "none" / "image.png", Image(2, 2), 0.0f), Error);
    EXPECT_THROW(writePng(folder.path(), Image(2, 2), 0.0f), Error);
    EXPECT_THROW(writePng("/proc/image.png", Image(2, 2), 0.0f), Error);
    EXPECT_EQ(folder.count(), 0);
}

} // namespace
} // namespace lavalight
