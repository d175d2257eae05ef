// Noise passes, however few samples tell of it, and what is no noise fails.
#include "compare/welch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "image/rendering.h"

namespace lavalight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Estimate estimateOf(const Rendering& rendering) {
    return {&rendering.radiance(), &rendering.variance(), rendering.sampleCounts};
}

// A wall lit by a rare path: a sample is `value` with the given probability, else 0.01.
Rendering rareLight(uint32_t samples, double probability, float value, unsigned seed) {
    constexpr uint32_t kSide = 64;
    std::mt19937 generator(seed);
    std::binomial_distribution<uint32_t> hits(samples, probability);
    Rendering r{Image(kSide, kSide), Image(kSide, kSide), std::vector<uint32_t>(kSide * kSide, samples)};
    for (size_t i = 0; i < r.radiance().pixels.size(); ++i) {
        const float share = static_cast<float>(hits(generator)) / static_cast<float>(samples);
        r.radiance().pixels[i] = glm::vec3(0.01f + share * (value - 0.01f));
        r.variance().pixels[i] = glm::vec3(share * (1.0f - share) * (value - 0.01f) * (value - 0.01f) /
                                           static_cast<float>(samples - 1));
    }
    return r;
}

double smallestP(const Rendering& a, const Rendering& b) {
    const double pixels = welchTest(estimateOf(a), estimateOf(b), 1).p;
    return std::min(pixels, welchTest(estimateOf(a), estimateOf(b), 16).p);
}

TEST(WelchTest, EqualRendersAreCertainlyEqual) {
    const Rendering a = rareLight(16, 0.05, 3.0f, 1);
    const WelchTest test = welchTest(estimateOf(a), estimateOf(a), 16);
    EXPECT_EQ(test.p, 1.0);
    EXPECT_EQ(test.maxAbsZ, 0.0f);
    EXPECT_EQ(test.absZ.size(), 3u * 16u);
    EXPECT_EQ(test.fractionBelow(3.3f), 1.0);
}

// 20 pairs: with a false alarm in 100 comparisons, three of them come in 1 of 1000 runs; the seeds are fixed.
TEST(WelchTest, RareLightIsNoDifference) {
    int alarms = 0;
    for (unsigned seed = 0; seed < 20; ++seed)
        alarms +=
            smallestP(rareLight(16, 0.05, 3.0f, 2 * seed), rareLight(16, 0.05, 3.0f, 2 * seed + 1)) < 0.01;
    EXPECT_LE(alarms, 1);
}

// The few samples miss the rare light in most pixels, and then have no variance at all.
TEST(WelchTest, RareLightThatFewSamplesMissIsNoDifference) {
    int alarms = 0;
    for (unsigned seed = 0; seed < 20; ++seed)
        alarms +=
            smallestP(rareLight(16, 0.01, 3.0f, 2 * seed), rareLight(1024, 0.01, 3.0f, 2 * seed + 1)) < 0.01;
    EXPECT_LE(alarms, 1);
}

TEST(WelchTest, ALittleLessLightIsADifference) {
    const Rendering a = rareLight(64, 0.5, 1.0f, 1);
    const Rendering b = rareLight(64, 0.45, 1.0f, 2);
    EXPECT_LT(smallestP(a, b), 1e-9);
}

TEST(WelchTest, OneDeadPixelIsADifferenceAndNamed) {
    const Rendering a = rareLight(256, 0.5, 1.0f, 1);
    Rendering b = rareLight(256, 0.5, 1.0f, 2);
    b.radiance().pixels[64 * 5 + 7] = glm::vec3(0.0f);
    const WelchTest test = welchTest(estimateOf(b), estimateOf(a), 1);
    EXPECT_LT(test.p, 1e-9);
    EXPECT_EQ(test.worstTile, glm::uvec2(7, 5));
    EXPECT_GT(test.worstAbsZ, 9.0f);
}

Rendering pixel(float radiance, float variance, uint32_t samples) {
    Rendering r{Image(1, 1), Image(1, 1), {samples}};
    r.radiance().pixels[0] = glm::vec3(radiance);
    r.variance().pixels[0] = glm::vec3(variance);
    return r;
}

// Tables of Student's t have 0.05 at 4.303 with 2 degrees, at 2.776 with 4, and the normal distribution has
// it at 1.960.
TEST(WelchTest, FewSamplesHaveTheTailsOfStudentsT) {
    const Rendering reference = pixel(1.0f, 0.0f, 3);
    EXPECT_NEAR(welchTest(estimateOf(pixel(5.303f, 1.0f, 3)), estimateOf(reference), 1).p, 3 * 0.05, 1e-3);
    const Rendering noisy = pixel(1.0f, 0.5f, 3);
    EXPECT_NEAR(welchTest(estimateOf(pixel(3.776f, 0.5f, 3)), estimateOf(noisy), 1).p, 3 * 0.05, 1e-3);
    const Rendering shifted = pixel(2.96f, 1.0f, 3);
    const Estimate withoutCounts{&shifted.radiance(), &shifted.variance(), {}};
    const Estimate exact{&reference.radiance(), nullptr, {}};
    EXPECT_NEAR(welchTest(withoutCounts, exact, 1).p, 3 * 0.05, 1e-3);
}

TEST(WelchTest, WhatRoundingExplainsIsNoDifference) {
    const Rendering a = pixel(1.0f, 0.0f, 8);
    EXPECT_EQ(welchTest(estimateOf(pixel(1.00009f, 0.0f, 8)), estimateOf(a), 1).p, 1.0);
    EXPECT_EQ(welchTest(estimateOf(pixel(1.0002f, 0.0f, 8)), estimateOf(a), 1).p, 0.0);
    EXPECT_EQ(welchTest(estimateOf(pixel(1.0002f, 0.0f, 8)), estimateOf(a), 1).maxAbsZ, kInfinity);
}

TEST(WelchTest, ImagesOfOneSampleHaveNoPixelThatCanBeTested) {
    const Rendering one = pixel(9.0f, 0.0f, 1);
    const Rendering many = pixel(1.0f, 0.5f, 8);
    EXPECT_FALSE(hasTestablePixel(estimateOf(one), estimateOf(many)));
    EXPECT_FALSE(hasTestablePixel(estimateOf(many), estimateOf(one)));
    EXPECT_TRUE(hasTestablePixel(estimateOf(many), estimateOf(many)));
}

TEST(WelchTest, PixelsOfOneSampleAreLeftOutAndNanNeverPasses) {
    const Rendering a = pixel(1.0f, 0.0f, 8);
    EXPECT_EQ(welchTest(estimateOf(pixel(9.0f, 0.0f, 1)), estimateOf(a), 1).p, 1.0);
    EXPECT_EQ(welchTest(estimateOf(pixel(std::nanf(""), 1.0f, 8)), estimateOf(a), 1).p, 0.0);
}

Rendering wall(uint32_t width, uint32_t height, float radiance, float variance) {
    Rendering r{Image(width, height), Image(width, height), {}};
    std::fill(r.radiance().pixels.begin(), r.radiance().pixels.end(), glm::vec3(radiance));
    std::fill(r.variance().pixels.begin(), r.variance().pixels.end(), glm::vec3(variance));
    return r;
}

TEST(WelchTest, ZOfEachTileIsItsDifferenceOverItsDeviation) {
    Rendering a = wall(5, 2, 1.0f, 0.25f); // tiles of 2 x 2, 2 x 2 and 1 x 2
    a.radiance().pixels[4].y += 0.5f;
    a.radiance().pixels[9].y += 1.0f;
    const WelchTest test = welchTest(estimateOf(a), estimateOf(wall(5, 2, 1.0f, 0.25f)), 2);
    ASSERT_EQ(test.absZ.size(), 9u);
    EXPECT_FLOAT_EQ(test.maxAbsZ, 1.5f); // (0.5 + 1) / sqrt(2 * (0.25 + 0.25))
    EXPECT_EQ(test.worstTile, glm::uvec2(4, 0));
    EXPECT_EQ(test.worstChannel, 1);
    EXPECT_DOUBLE_EQ(test.fractionBelow(1.0f), 8.0 / 9.0);
}

TEST(WelchTest, WithoutVarianceAnyDifferenceIsInfinite) {
    Rendering a = wall(2, 1, 3.0f, 0.0f);
    const Rendering b = a;
    EXPECT_EQ(welchTest(estimateOf(a), estimateOf(b), 1).maxAbsZ, 0.0f);
    a.radiance().pixels[1].z += 1e-2f;
    const WelchTest test = welchTest(estimateOf(a), estimateOf(b), 1);
    EXPECT_EQ(test.maxAbsZ, kInfinity);
    EXPECT_EQ(test.worstTile, glm::uvec2(1, 0));
    EXPECT_DOUBLE_EQ(test.fractionBelow(3.3f), 5.0 / 6.0);
}

TEST(WelchTest, NanIsInfinitelyFarFromAll) {
    const WelchTest test =
        welchTest(estimateOf(wall(1, 1, std::nanf(""), 1.0f)), estimateOf(wall(1, 1, 1.0f, 1.0f)), 1);
    EXPECT_EQ(test.maxAbsZ, kInfinity);
    EXPECT_EQ(test.fractionBelow(3.3f), 0.0);
}

TEST(WelchTest, TilesKeepTheVarianceOfEachImage) {
    const std::vector<TileDifference> tiles =
        tileDifferences(estimateOf(wall(3, 2, 2.0f, 0.5f)), estimateOf(wall(3, 2, 1.5f, 0.125f)), 2);
    ASSERT_EQ(tiles.size(), 2u);
    EXPECT_EQ(tiles[1].first, glm::uvec2(2, 0));
    EXPECT_EQ(tiles[1].difference, glm::dvec3(1.0));
    EXPECT_EQ(tiles[1].reference, glm::dvec3(3.0));
    EXPECT_EQ(tiles[1].imageVariance, glm::dvec3(1.0));
    EXPECT_EQ(tiles[1].referenceVariance, glm::dvec3(0.25));
    EXPECT_EQ(tiles[1].variance, glm::dvec3(1.25));
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

WelchTest zTest(const Rendering& a, const Rendering& b, uint32_t tileSize) {
    return welchTest(estimateOf(a), estimateOf(b), tileSize);
}

TEST(WelchTest, TwoRendersOfTheSameWallDifferAsANormalDeviateDoes) {
    const Rendering a = noisyRendering(0.5f, 1);
    const Rendering b = noisyRendering(0.5f, 2);
    // 49152 tests each; the standard deviation of such a fraction is at most 0.0023.
    const WelchTest pixels = zTest(a, b, 1);
    EXPECT_NEAR(pixels.fractionBelow(1.0f), 0.6827, 0.01);
    EXPECT_NEAR(pixels.fractionBelow(2.0f), 0.9545, 0.005);
    EXPECT_NEAR(pixels.fractionBelow(3.3f), 0.99903, 0.001);
    EXPECT_GT(zTest(a, b, 16).fractionBelow(3.3f), 0.98); // 192 tests: at most three outside
    EXPECT_LT(zTest(a, b, 128).maxAbsZ, 3.3f);
}

TEST(WelchTest, OnePerCentOfBiasIsCaughtThoughNoPixelShowsIt) {
    const Rendering a = noisyRendering(0.5f, 1);
    const Rendering b = noisyRendering(0.505f, 2);
    EXPECT_NEAR(zTest(a, b, 1).fractionBelow(3.3f), 0.999, 0.001);
    // Each channel has 128^2 * 64 samples: the bias is 0.01 / sqrt(2 / 1.05e6) = 7.2 standard deviations.
    const WelchTest whole = zTest(a, b, 128);
    EXPECT_EQ(whole.fractionBelow(3.3f), 0.0);
}

TEST(WelchTest, SizesMustAgree) {
    const Rendering a = pixel(1.0f, 0.0f, 8);
    const Rendering b = rareLight(16, 0.05, 3.0f, 1);
    EXPECT_THROW((void)welchTest(estimateOf(a), estimateOf(b), 1), Error);
}

} // namespace
} // namespace lavalight
