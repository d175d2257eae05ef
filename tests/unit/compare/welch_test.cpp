// Noise passes, however few samples tell of it, and what is no noise fails.
#include "compare/welch.h"

#include <algorithm>
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

TEST(WelchTest, PixelsOfOneSampleAreLeftOutAndNanNeverPasses) {
    const Rendering a = pixel(1.0f, 0.0f, 8);
    EXPECT_EQ(welchTest(estimateOf(pixel(9.0f, 0.0f, 1)), estimateOf(a), 1).p, 1.0);
    EXPECT_EQ(welchTest(estimateOf(pixel(std::nanf(""), 1.0f, 8)), estimateOf(a), 1).p, 0.0);
}

TEST(WelchTest, SizesMustAgree) {
    const Rendering a = pixel(1.0f, 0.0f, 8);
    const Rendering b = rareLight(16, 0.05, 3.0f, 1);
    EXPECT_THROW((void)welchTest(estimateOf(a), estimateOf(b), 1), Error);
}

} // namespace
} // namespace lavalight
