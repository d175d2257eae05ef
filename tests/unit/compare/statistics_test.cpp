// The error measures equal their definitions, and the Z-test tells noise from bias.
#include "compare/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

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
    EXPECT_THROW((void)tileZTest(a, a, a, b, 1), Error);
    EXPECT_THROW((void)rmse(Image(), Image()), Error);
}

TEST(TileZTest, ComputesZOfEachTileAndFindsTheWorst) {
    Image a = constant(5, 2, glm::vec3(1.0f)); // tiles of 2 x 2, 2 x 2 and 1 x 2
    a.pixels[4].y += 0.5f;
    a.pixels[9].y += 1.0f;
    const Image variance = constant(5, 2, glm::vec3(0.25f));
    const ZTest test = tileZTest(a, variance, constant(5, 2, glm::vec3(1.0f)), variance, 2);
    EXPECT_EQ(test.tileCount, 3u);
    ASSERT_EQ(test.absZ.size(), 9u);
    EXPECT_FLOAT_EQ(test.maxAbsZ, 1.5f); // (0.5 + 1) / sqrt(2 * (0.25 + 0.25))
    EXPECT_EQ(test.worstTile, glm::uvec2(4, 0));
    EXPECT_EQ(test.worstChannel, 1);
    EXPECT_DOUBLE_EQ(test.fractionBelow(1.0f), 8.0 / 9.0);
}

TEST(TileZTest, WithoutVarianceOnlyEqualMeansPass) {
    const Image zero = constant(2, 1, glm::vec3(0.0f));
    Image a = constant(2, 1, glm::vec3(3.0f));
    const Image b = a;
    EXPECT_EQ(tileZTest(a, zero, b, zero, 1).maxAbsZ, 0.0f);
    a.pixels[1].z += 1e-6f;
    const ZTest test = tileZTest(a, zero, b, zero, 1);
    EXPECT_EQ(test.maxAbsZ, kInfinity);
    EXPECT_EQ(test.worstTile, glm::uvec2(1, 0));
    EXPECT_DOUBLE_EQ(test.fractionBelow(3.3f), 5.0 / 6.0);
}

TEST(TileZTest, NanNeverPasses) {
    const Image variance = constant(1, 1, glm::vec3(1.0f));
    const ZTest test = tileZTest(constant(1, 1, glm::vec3(std::nanf(""))), variance, variance, variance, 1);
    EXPECT_EQ(test.maxAbsZ, kInfinity);
    EXPECT_EQ(test.fractionBelow(3.3f), 0.0);
}

// What a render of a grey wall leaves: each pixel is the mean of `samples` exponential variates (sigma =
// mean, as of a light that is found by chance), with the variance estimated from the same samples.
Rendering noisyRendering(float mean, unsigned seed) {
    constexpr uint32_t kSide = 128;
    constexpr int kSamples = 64;
    std::mt19937 generator(seed);
    std::exponential_distribution<double> sample(1.0 / mean);
    Rendering rendering{Image(kSide, kSide), Image(kSide, kSide),
                        std::vector<uint32_t>(kSide * kSide, kSamples)};
    for (size_t i = 0; i < rendering.radiance().pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            double sum = 0.0;
            double sumOfSquares = 0.0;
            for (int s = 0; s < kSamples; ++s) {
                const double value = sample(generator);
                sum += value;
                sumOfSquares += value * value;
            }
            const double variance = (sumOfSquares - sum * sum / kSamples) / (kSamples - 1);
            rendering.radiance().pixels[i][c] = static_cast<float>(sum / kSamples);
            rendering.variance().pixels[i][c] = static_cast<float>(variance / kSamples);
        }
    return rendering;
}

ZTest zTest(const Rendering& a, const Rendering& b, uint32_t tileSize) {
    return tileZTest(a.radiance(), a.variance(), b.radiance(), b.variance(), tileSize);
}

TEST(TileZTest, TwoRendersOfTheSameWallDifferAsANormalDeviateDoes) {
    const Rendering a = noisyRendering(0.5f, 1);
    const Rendering b = noisyRendering(0.5f, 2);
    // 49152 tests each; the standard deviation of such a fraction is at most 0.0023.
    const ZTest pixels = zTest(a, b, 1);
    EXPECT_NEAR(pixels.fractionBelow(1.0f), 0.6827, 0.01);
    EXPECT_NEAR(pixels.fractionBelow(2.0f), 0.9545, 0.005);
    EXPECT_NEAR(pixels.fractionBelow(3.3f), 0.99903, 0.001);
    EXPECT_GT(zTest(a, b, 16).fractionBelow(3.3f), 0.98); // 192 tests: at most three outside
    EXPECT_LT(zTest(a, b, 128).maxAbsZ, 3.3f);
}

TEST(TileZTest, OnePerCentOfBiasIsCaughtThoughNoPixelShowsIt) {
    const Rendering a = noisyRendering(0.5f, 1);
    const Rendering b = noisyRendering(0.505f, 2);
    EXPECT_NEAR(zTest(a, b, 1).fractionBelow(3.3f), 0.999, 0.001);
    // Each channel has 128^2 * 64 samples: the bias is 0.01 / sqrt(2 / 1.05e6) = 7.2 standard deviations.
    const ZTest whole = zTest(a, b, 128);
    EXPECT_EQ(whole.fractionBelow(3.3f), 0.0);
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
    const Rendering rendering = noisyRendering(0.5f, 3);
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
