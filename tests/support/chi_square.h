// Pearson's chi-square test: whether counts in bins may have come from given probabilities.
#pragma once

#include <cstdint>
#include <vector>

namespace lavalight::test {

struct ChiSquare {
    double statistic = 0.0;
    double degrees = 0.0; // degrees of freedom
    double pValue = 1.0;  // probability of a statistic at least as large if the probabilities hold
};

// A test fails below this p-value. Seeds are fixed, so a test that passes once passes always; over the few
// hundred tests of this suite, one in ten thousand leaves a few per cent that a correct sampler has to be
// given another seed.
constexpr double kLeastPValue = 1e-4;

// `expected` counts per bin, of the same sum as `observed` up to rounding. Bins that expect fewer than five
// are pooled: the statistic's distribution is that of chi-square only for larger ones.
[[nodiscard]] ChiSquare chiSquare(const std::vector<uint32_t>& observed, const std::vector<double>& expected);

// The test for bins of equal probability.
[[nodiscard]] ChiSquare chiSquareUniform(const std::vector<uint32_t>& observed);

} // namespace lavalight::test
