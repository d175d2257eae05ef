// Tests of means and variances put together from parts.
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "lab/moments.h"

namespace lavalight::test {
namespace {

TEST(Moments, OfKnownNumbersAreTheirMeanAndVariance) {
    const Moments m = momentsOf(std::array<double, 4>{1.0, 2.0, 4.0, 9.0});
    EXPECT_DOUBLE_EQ(m.mean, 4.0);
    EXPECT_DOUBLE_EQ(m.variance(), (9.0 + 4.0 + 0.0 + 25.0) / 3.0);
    EXPECT_DOUBLE_EQ(m.standardError(), std::sqrt(38.0 / 3.0 / 4.0));
}

TEST(Moments, OfPartsAreThoseOfTheWhole) {
    std::vector<double> values;
    values.reserve(100);
    for (int i = 0; i < 100; ++i)
        values.push_back(1e6 + i % 7 - 0.3 * (i % 11)); // a large mean: sums of squares would cancel
    const Moments whole = momentsOf(values);
    const std::span<const double> all(values);
    const Moments parts = merged(std::array<Moments, 3>{
        momentsOf(all.first(13)), momentsOf(all.subspan(13, 50)), momentsOf(all.subspan(63))});
    EXPECT_EQ(parts.count, 100u);
    EXPECT_NEAR(parts.mean, whole.mean, 1e-9);
    EXPECT_NEAR(parts.variance(), whole.variance(), 1e-8);
}

TEST(Moments, OfNothingAndOfOneNumberHaveNoVariance) {
    EXPECT_EQ(Moments{}.variance(), 0.0);
    EXPECT_EQ(Moments{}.standardError(), 0.0);
    EXPECT_EQ(momentsOf(std::array<double, 1>{5.0}).variance(), 0.0);
    EXPECT_EQ(merged(Moments{}, momentsOf(std::array<double, 1>{5.0})).mean, 5.0);
}

} // namespace
} // namespace lavalight::test
