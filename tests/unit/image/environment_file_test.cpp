// Environment maps as found in the wild, whole and broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "base/error.h"
#include "image/environment_file.h"
#include "image/exr.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

class EnvironmentAssets : public testing::Test {
  protected:
    void SetUp() override {
        const char* assets = std::getenv("LAVALIGHT_ASSETS");
        if (assets == nullptr)
            GTEST_SKIP() << "LAVALIGHT_ASSETS is not set";
        assets_ = assets;
    }
    [[nodiscard]] Image read(const std::string& name) const {
        return readEnvironmentFile(assets_ / "_env" / name).image;
    }
    std::filesystem::path assets_;
};

float largestRelativeDifference(const Image& a, const Image& b) {
    float largest = 0.0f;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]) / (b.pixels[i][c] + 0.05f));
    return largest;
}

TEST(EnvironmentFile, IsKnownByItsExtensionInEitherCase) {
    for (const char* name : {"sky.hdr", "sky.HDR", "a/b.c/sky.Exr", "sky.pic"})
        EXPECT_TRUE(hasEnvironmentExtension(name)) << name;
    for (const char* name : {"sky.gltf", "hdr", ".hdr", "sky.hdr2", "sky.hd", "exr/sky", ""})
        EXPECT_FALSE(hasEnvironmentExtension(name)) << name;
}

TEST_F(EnvironmentAssets, EveryCompressionOfOpenExrHoldsTheMapThatTheHdrHolds) {
    const Image hdr = read("venice_sunset_256.hdr");
    for (const char* name : {"none_float", "rle_half", "zips_half", "zip_half", "zip_float", "piz_half",
                             "pxr24_float", "b44_half"}) {
        const Image exr = read("exr-variants/venice_256_" + std::string(name) + ".exr");
        ASSERT_EQ(exr.width, 256u) << name;
        ASSERT_EQ(exr.height, 128u) << name;
        const bool isLossy = std::string(name).starts_with("b44");
        EXPECT_LT(largestRelativeDifference(exr, hdr), isLossy ? 0.6f : 2e-3f) << name;
    }
}

TEST_F(EnvironmentAssets, MapsAreRead) {
    EXPECT_EQ(read("chinese_garden_1k.hdr").width, 1024u);
    EXPECT_GT(read("blender_city.exr").width, 0u); // DWAB
    EXPECT_EQ(read("tiny_simple-rle.hdr").height, 2u);
    EXPECT_EQ(read("furnace_white_64x32.hdr").at(63, 31), glm::vec3(1.0f));
    EXPECT_NEAR(read("one_bright_texel_128x64.hdr").at(32, 16).x, 5000.0f, 5000.0f / 256.0f);
}

TEST_F(EnvironmentAssets, QuadrantsAreRedGreenBlueYellowFromTheLeft) {
    const Image map = read("quadrants_128x64.hdr");
    const auto isOn = [&](uint32_t x, const glm::bvec3& channels) {
        const glm::vec3 color = map.at(x, 32);
        return glm::greaterThan(color, glm::vec3(0.5f)) == channels;
    };
    EXPECT_TRUE(isOn(16, {true, false, false}));
    EXPECT_TRUE(isOn(48, {false, true, false}));
    EXPECT_TRUE(isOn(80, {false, false, true}));
    EXPECT_TRUE(isOn(112, {true, true, false}));
}

TEST_F(EnvironmentAssets, BrokenMapsAreRefusedWithTheirName) {
    for (const char* name : {"hdr_truncated_000000.hdr", "hdr_truncated_000040.hdr",
                             "hdr_truncated_000090.hdr", "hdr_truncated_132654.hdr", "hdr_dims_huge.hdr",
                             "hdr_dims_zero.hdr", "hdr_rle_overrun.hdr", "exr_truncated_000000.exr",
                             "exr_truncated_000050.exr", "exr_truncated_000300.exr", "png_as_hdr.hdr"}) {
        try {
            (void)readEnvironmentFile(assets_ / "invalid/generated/env" / name);
            ADD_FAILURE() << name << " was read";
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find(name), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
}

TEST(EnvironmentFile, ValuesThatAreNoRadianceBecomeZeroAndAreCounted) {
    const TemporaryFolder folder;
    Rendering rendering{Image(3, 2), Image(3, 2), std::vector<uint32_t>(6, 1)};
    rendering.radiance().pixels = {{1, 2, 3},
                                   {-1, 2, 3},
                                   {1, std::numeric_limits<float>::quiet_NaN(), 3},
                                   {1, 2, std::numeric_limits<float>::infinity()},
                                   {0, 0, 0},
                                   {-1, -1, -1}};
    writeExr(folder / "map.exr", rendering, {});
    const EnvironmentFile file = readEnvironmentFile(folder / "map.exr");
    EXPECT_EQ(file.badTexels, 4u);
    EXPECT_EQ(file.image.pixels[0], glm::vec3(1, 2, 3));
    EXPECT_EQ(file.image.pixels[1], glm::vec3(0, 2, 3));
    EXPECT_EQ(file.image.pixels[2], glm::vec3(1, 0, 3));
    EXPECT_EQ(file.image.pixels[3], glm::vec3(1, 2, 0));
    EXPECT_EQ(file.image.pixels[5], glm::vec3(0.0f));
}

} // namespace
} // namespace lavalight::test
