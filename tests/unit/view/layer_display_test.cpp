// Layers as a display shows them.
#include "view/layer_display.h"

#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "film/film_layout.h"
#include "image/srgb.h"

namespace lavalight::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

uint32_t grey(uint32_t code) {
    return code | code << 8u | code << 16u | 0xff000000u;
}

// A row of pixels with these values, and a layer that says which of them met something.
Rendering layersOf(uint32_t row, const std::vector<glm::vec3>& values, const std::vector<float>& hits) {
    Rendering rendering;
    const auto add = [&](uint32_t plane, const auto& value) {
        Image image(static_cast<uint32_t>(values.size()), 1);
        for (size_t i = 0; i < values.size(); ++i)
            image.pixels[i] = value(i);
        rendering.layers.push_back({planeName(plane), {}, std::move(image), std::nullopt});
    };
    add(row, [&](size_t i) { return values[i]; });
    add(kHitsPlane, [&](size_t i) { return glm::vec3(hits[i], 0.0f, 0.0f); });
    return rendering;
}

std::vector<uint32_t> shown(uint32_t row, const std::vector<glm::vec3>& values,
                            const std::vector<float>& hits, float scale = 1.0f) {
    return displayOf(layersOf(row, values, hits), row, scale);
}

TEST(LayerDisplay, NormalsAreHalvedAndNothingIsBlack) {
    const auto pixels = shown(kNormalPlane, {{0.0f, 1.0f, -1.0f}, {0.0f, 0.0f, 0.0f}}, {1.0f, 0.0f});
    EXPECT_EQ(pixels[0], 0xff00ff80u);
    EXPECT_EQ(pixels[1], 0xff000000u);
}

TEST(LayerDisplay, TheNearestIsWhiteAndTheFarthestIsNotTheBackground) {
    const auto pixels = shown(kDepthPlane, {{2.0f, 0, 0}, {4.0f, 0, 0}, {3.0f, 0, 0}, {0.0f, 0, 0}},
                              {1.0f, 0.5f, 1.0f, 0.0f});
    EXPECT_EQ(pixels[0], grey(255));
    EXPECT_EQ(pixels[1], grey(26)); // a tenth
    EXPECT_EQ(pixels[2], grey(140));
    EXPECT_EQ(pixels[3], grey(0));
}

TEST(LayerDisplay, PositionsReachFromTheLeastToTheLargestOfEachAxis) {
    const auto pixels = shown(kPositionPlane, {{-1.0f, 5.0f, 2.0f}, {1.0f, 5.0f, 0.0f}}, {1.0f, 1.0f});
    EXPECT_EQ(pixels[0], 0xffff0000u);
    EXPECT_EQ(pixels[1], 0xff0000ffu) << "an axis without extent is black";
}

TEST(LayerDisplay, AlbedoIsAColourAndEmissionRadianceThatIsExposed) {
    const glm::vec3 color(0.5f, 2.0f, -1.0f);
    const uint32_t half = encodeSrgb8(0.5f);
    EXPECT_EQ(shown(kAlbedoPlane, {color}, {0.0f}, 0.25f)[0], 0xff000000u | 255u << 8u | half);
    EXPECT_EQ(shown(kEmissionPlane, {color}, {0.0f}, 0.25f)[0],
              0xff000000u | half << 8u | encodeSrgb8(0.125f));
}

TEST(LayerDisplay, ASingleComponentIsGreyWhateverElseIsInThePicture) {
    const auto pixels = shown(kHitsPlane, {{0.25f, 9.0f, 9.0f}, {0.75f, 0, 0}, {kInfinity, 0, 0}}, {1, 1, 1});
    EXPECT_EQ(pixels[0], grey(0));
    EXPECT_EQ(pixels[1], grey(255));
    EXPECT_EQ(pixels[2], grey(255));
}

TEST(LayerDisplay, WhatIsEqualEverywhereIsOneGrey) {
    EXPECT_EQ(shown(kDepthPlane, {{3.0f, 0, 0}}, {1.0f})[0], grey(255));
}

TEST(Checkerboard, OpaquePixelsStayAndClearOnesShowSquaresOfTheWindow) {
    std::vector<uint32_t> pixels(16, 0u);
    pixels[5] = 0xff123456u;
    putOnCheckerboard(pixels, 4, {32, 32}); // each pixel is one square
    for (size_t i = 0; i < pixels.size(); ++i)
        EXPECT_EQ(pixels[i], i == 5 ? 0xff123456u : (i % 4 + i / 4) % 2 == 0 ? grey(0x99) : grey(0x66)) << i;
}

TEST(Checkerboard, HalfCoverageMixesHalves) {
    std::vector<uint32_t> pixels{0x80ffffffu};
    putOnCheckerboard(pixels, 1, {8, 8});
    EXPECT_EQ(pixels[0], grey((0xff * 128 + 0x99 * 127 + 127) / 255));
}

} // namespace
} // namespace lavalight::test
