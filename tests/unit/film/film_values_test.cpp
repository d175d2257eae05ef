// Host side of the film: fixed-point numbers and what sums of samples estimate.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/film.h"

namespace lavalight {
namespace {

TEST(FixedPoint, LowestWordCountsInUnitsOfTheLowestExponent) {
    EXPECT_EQ(fromFixed(std::array<uint32_t, 3>{0, 0, 0}, -48), 0.0);
    EXPECT_EQ(fromFixed(std::array<uint32_t, 3>{1, 0, 0}, -48), std::ldexp(1.0, -48));
    EXPECT_EQ(fromFixed(std::array<uint32_t, 3>{0, 1u << 16, 0}, -48), 1.0);
    EXPECT_EQ(fromFixed(std::array<uint32_t, 4>{5, 0, 3, 1}, -64),
              5 * std::ldexp(1.0, -64) + 3.0 + 4294967296.0);
}

TEST(FixedPoint, AllOnesIsTheLargestValue) {
    const std::array<uint32_t, 3> words{0xffffffffu, 0xffffffffu, 0xffffffffu};
    EXPECT_EQ(fromFixed(words, kSumLowestExponent),
              std::ldexp(1.0, 96 + kSumLowestExponent)); // rounded to a double
}

TEST(FixedPoint, TwosComplementIsExactNearZeroOnBothSides) {
    EXPECT_EQ(fromSigned(std::array<uint32_t, 4>{1, 0, 0, 0}, -48), std::ldexp(1.0, -48));
    EXPECT_EQ(fromSigned(std::array<uint32_t, 4>{0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu}, -48),
              -std::ldexp(1.0, -48));
    EXPECT_EQ(fromSigned(std::array<uint32_t, 4>{0, 0xffff0000u, 0xffffffffu, 0xffffffffu}, -48), -1.0);
    EXPECT_EQ(fromSigned(std::array<uint32_t, 4>{0, 0, 0, 0x80000000u}, -48), -std::ldexp(1.0, 79));
    EXPECT_EQ(fromSigned(std::array<uint32_t, 4>{0, 0, 0, 0x40000000u}, -48), std::ldexp(1.0, 78));
}

PixelEstimate estimateOf(const std::vector<double>& samples) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double sample : samples) {
        sum += sample;
        squares += sample * sample;
    }
    return estimate(sum, squares, static_cast<uint32_t>(samples.size()));
}

TEST(Estimate, IsTheMeanWithTheVarianceOfTheMean) {
    const PixelEstimate e = estimateOf({1.0, 2.0, 3.0, 6.0});
    EXPECT_DOUBLE_EQ(e.mean, 3.0);
    // Squared deviations 4 + 1 + 0 + 9 over n - 1 = 3 give the samples' variance, over n = 4 that of their
    // mean.
    EXPECT_DOUBLE_EQ(e.varianceOfMean, 14.0 / 12.0);
}

TEST(Estimate, EqualSamplesHaveNoVariance) {
    EXPECT_EQ(estimateOf({0.5, 0.5, 0.5}).varianceOfMean, 0.0);
    EXPECT_GE(estimateOf({0.1, 0.1, 0.1}).varianceOfMean, 0.0); // rounding must not make it negative
}

TEST(Estimate, OneSampleHasAMeanAlone) {
    EXPECT_EQ(estimateOf({7.0}).mean, 7.0);
    EXPECT_EQ(estimateOf({7.0}).varianceOfMean, 0.0);
}

TEST(Estimate, NoSampleIsBlack) {
    EXPECT_EQ(estimateOf({}).mean, 0.0);
    EXPECT_EQ(estimateOf({}).varianceOfMean, 0.0);
}

} // namespace
} // namespace lavalight
