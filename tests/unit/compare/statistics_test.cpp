// The error measures equal their definitions.
#include "compare/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image constant(uint32_t width, uint32_t height, glm::vec3 value) {
    Image image(width, height);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

TEST(Rmse, EqualsTheDefinitionByHand) {
    Image image(2, 1);
    image.pixels = {{1.0f, 2.0f, 3.0f}, {0.0f, 0.0f, 5.0f}};
    Image reference(2, 1);
    reference.pixels = {{1.0f, 1.0f, 1.0f}, {0.0f, 1.0f, 1.0f}};
    EXPECT_DOUBLE_EQ(rmse(image, reference), std::sqrt((0.0 + 1.0 + 4.0 + 0.0 + 1.0 + 16.0) / 6.0));
    EXPECT_EQ(rmse(image, image), 0.0);
}

TEST(RelMse, EqualsTheDefinitionByHand) {
    Image image(2, 1);
    image.pixels = {{2.0f, 0.0f, 0.5f}, {0.5f, 0.5f, 0.5f}};
    Image reference(2, 1);
    reference.pixels = {{1.0f, 0.0f, 0.0f}, {0.5f, 0.5f, 0.5f}};
    EXPECT_DOUBLE_EQ(relMse(image, reference), (1.0 / 1.01 + 0.25 / 0.01) / 6.0);
}

TEST(TrimmedRelMse, DropsOnePixelInAThousandAndNoMore) {
    const Image reference = constant(50, 40, glm::vec3(1.0f)); // 2000 pixels: two are dropped
    Image image = constant(50, 40, glm::vec3(1.1f));
    const double ordinary = relMse(image, reference);
    image.pixels[7] = glm::vec3(1000.0f);
    image.pixels[1999] = {1.1f, 1.1f, std::nanf("")};
    EXPECT_NEAR(trimmedRelMse(image, reference), ordinary, 1e-12 * ordinary);
    image.pixels[100] = glm::vec3(3.0f);
    EXPECT_NEAR(trimmedRelMse(image, reference), (1997.0 * ordinary + 4.0 / 1.01) / 1998.0, 1e-9);
}

TEST(TrimmedRelMse, EqualsRelMseBelowAThousandPixels) {
    const Image reference = constant(27, 37, glm::vec3(1.0f));
    Image image = reference;
    image.pixels[3] = glm::vec3(5.0f);
    EXPECT_DOUBLE_EQ(trimmedRelMse(image, reference), relMse(image, reference));
}

TEST(RelativeMeanDifference, IsPerChannelAndOverall) {
    const Image reference = constant(4, 4, {1.0f, 2.0f, 5.0f});
    const MeanDifference difference = relativeMeanDifference(constant(4, 4, {1.5f, 2.0f, 2.5f}), reference);
    EXPECT_DOUBLE_EQ(difference.perChannel.r, 0.5);
    EXPECT_DOUBLE_EQ(difference.perChannel.g, 0.0);
    EXPECT_DOUBLE_EQ(difference.perChannel.b, -0.5);
    EXPECT_DOUBLE_EQ(difference.overall, 6.0 / 8.0 - 1.0);
}

TEST(RelativeMeanDifference, IsDefinedForBlackReferences) {
    const Image black = constant(2, 2, glm::vec3(0.0f));
    EXPECT_EQ(relativeMeanDifference(black, black).overall, 0.0);
    EXPECT_EQ(relativeMeanDifference(constant(2, 2, {0.0f, 1.0f, 0.0f}), black).perChannel,
              glm::dvec3(0.0, kInfinity, 0.0));
}

TEST(CountNonFinite, CountsPixelsNotChannels) {
    Image image(2, 2);
    image.pixels[1] = glm::vec3(std::nanf(""));
    image.pixels[2].z = -kInfinity;
    EXPECT_EQ(countNonFinite(image), 2u);
}

TEST(Comparisons, ThrowForDifferentSizesAndForNothing) {
    const Image a(2, 3);
    const Image b(3, 2);
    EXPECT_THROW((void)rmse(a, b), Error);
    EXPECT_THROW((void)relMse(a, b), Error);
    EXPECT_THROW((void)trimmedRelMse(a, b), Error);
    EXPECT_THROW((void)relativeMeanDifference(a, b), Error);
    EXPECT_THROW((void)rmse(Image(), Image()), Error);
}

TEST(Downsample, AveragesBoxesAndTheirVariances) {
    Rendering rendering{Image(3, 2), Image(3, 2), {1, 2, 3, 4, 5, 6}};
    for (uint32_t i = 0; i < 6; ++i) {
        rendering.radiance().pixels[i] = glm::vec3(static_cast<float>(i), 1.0f, 0.0f);
        rendering.variance().pixels[i] = glm::vec3(4.0f, static_cast<float>(i), 0.0f);
    }
    const Rendering small = downsample(rendering, 2);
    ASSERT_EQ(small.radiance().width, 2u);
    ASSERT_EQ(small.radiance().height, 1u);
    EXPECT_EQ(small.radiance().pixels[0], glm::vec3((0.0f + 1.0f + 3.0f + 4.0f) / 4.0f, 1.0f, 0.0f));
    EXPECT_EQ(small.variance().pixels[0], glm::vec3(16.0f / 16.0f, 8.0f / 16.0f, 0.0f));
    EXPECT_EQ(small.radiance().pixels[1],
              glm::vec3((2.0f + 5.0f) / 2.0f, 1.0f, 0.0f)); // the cut box: two pixels
    EXPECT_EQ(small.variance().pixels[1], glm::vec3(8.0f / 4.0f, 7.0f / 4.0f, 0.0f));
    EXPECT_EQ(small.sampleCounts, (std::vector<uint32_t>{1 + 2 + 4 + 5, 3 + 6}));
}

TEST(Downsample, ByOneChangesNothing) {
    Rendering rendering{Image(5, 3), Image(5, 3), std::vector<uint32_t>(15, 7)};
    for (size_t i = 0; i < 15; ++i) {
        rendering.radiance().pixels[i] = glm::vec3(0.1f, 0.7f, 3.0f) * static_cast<float>(i);
        rendering.variance().pixels[i] = glm::vec3(0.3f, 0.9f, 1.1f) * static_cast<float>(i);
    }
    const Rendering same = downsample(rendering, 1);
    EXPECT_EQ(same.radiance().pixels, rendering.radiance().pixels);
    EXPECT_EQ(same.variance().pixels, rendering.variance().pixels);
    EXPECT_EQ(same.sampleCounts, rendering.sampleCounts);
}

TEST(Downsample, SampleCountsSaturate) {
    Rendering rendering{Image(2, 1), Image(2, 1), {4'000'000'000u, 4'000'000'000u}};
    EXPECT_EQ(downsample(rendering, 2).sampleCounts[0], std::numeric_limits<uint32_t>::max());
}

TEST(Downsample, EveryLayerIsAveraged) {
    Rendering rendering{Image(2, 1), Image(2, 1), {1, 1}};
    Layer& layer = rendering.layers.emplace_back(Layer{"normal", {"normal.X"}, Image(2, 1), std::nullopt});
    layer.mean.pixels = {{-3.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}};
    const Rendering small = downsample(rendering, 2);
    ASSERT_NE(small.find("normal"), nullptr);
    EXPECT_EQ(small.find("normal")->mean.pixels.front(), glm::vec3(-1.0f, 0.0f, 0.0f));
    EXPECT_FALSE(small.find("normal")->variance.has_value());
}

} // namespace
} // namespace lavalight
