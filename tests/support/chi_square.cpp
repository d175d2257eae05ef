#include "support/chi_square.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace lavalight::test {
namespace {

constexpr double kLeastExpected = 5.0;

// Wilson, Hilferty, "The Distribution of Chi-Square", 1931: the cube root of chi-square over its degrees of
// freedom is nearly normal. From three degrees on, p-values near 1e-4 are right within a tenth of their size.
double upperTail(double statistic, double degrees) {
    const double spread = 2.0 / (9.0 * degrees);
    const double z = (std::cbrt(statistic / degrees) - (1.0 - spread)) / std::sqrt(spread);
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

} // namespace

ChiSquare chiSquare(const std::vector<uint32_t>& observed, const std::vector<double>& expected) {
    assert(observed.size() == expected.size());
    ChiSquare result;
    double pooledObserved = 0.0;
    double pooledExpected = 0.0;
    size_t bins = 0;
    for (size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < kLeastExpected) {
            pooledObserved += observed[i];
            pooledExpected += expected[i];
            continue;
        }
        const double difference = observed[i] - expected[i];
        result.statistic += difference * difference / expected[i];
        ++bins;
    }
    // Too small a pool for the statistic still must not hide counts where there can be none.
    const double pool = std::fmax(pooledExpected, kLeastExpected);
    result.statistic += (pooledObserved - pooledExpected) * (pooledObserved - pooledExpected) / pool;
    bins += pooledExpected >= kLeastExpected ? 1 : 0;
    result.degrees = static_cast<double>(bins) - 1.0;
    result.pValue =
        bins < 2 ? std::numeric_limits<double>::quiet_NaN() : upperTail(result.statistic, result.degrees);
    return result;
}

ChiSquare chiSquareUniform(const std::vector<uint32_t>& observed) {
    const double sum = std::accumulate(observed.begin(), observed.end(), 0.0);
    return chiSquare(observed,
                     std::vector<double>(observed.size(), sum / static_cast<double>(observed.size())));
}

} // namespace lavalight::test
