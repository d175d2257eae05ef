#include "compare/student_t.h"

#include <cassert>
#include <cmath>

namespace lavalight {
namespace {

// The continued fraction of the incomplete beta function (Abramowitz and Stegun 1964, 26.5.8) by the method
// of Lentz 1976; converges fast for x < (a + 1) / (a + b + 2).
double betaFraction(double x, double a, double b) {
    constexpr int kMostTerms = 10'000;
    constexpr double kConverged = 1e-14;
    constexpr double kTiny = 1e-300; // stands for a zero that would be divided by
    const auto nonZero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
    double c = 1.0;
    double d = 1.0 / nonZero(1.0 - (a + b) * x / (a + 1.0));
    double result = d;
    for (int m = 1; m < kMostTerms; ++m) {
        const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / nonZero(1.0 + even * d);
        c = nonZero(1.0 + even / c);
        result *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / nonZero(1.0 + odd * d);
        c = nonZero(1.0 + odd / c);
        result *= d * c;
        if (std::abs(d * c - 1.0) < kConverged)
            break;
    }
    return result;
}

// The regularised incomplete beta function I_x(a, b); y is 1 - x, which the caller knows without
// cancellation.
double regularisedBeta(double x, double y, double a, double b) {
    if (x <= 0.0)
        return 0.0;
    if (x > (a + 1.0) / (a + b + 2.0))
        return 1.0 - regularisedBeta(y, x, b, a);
    const double logFactor =
        std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log(y);
    return std::exp(logFactor) * betaFraction(x, a, b) / a;
}

} // namespace

double studentTwoSidedTail(double t, double degreesOfFreedom) {
    assert(t >= 0.0 && degreesOfFreedom > 0.0);
    constexpr double kNormal =
        1e7; // degrees beyond which lgamma's differences are worse than the normal limit
    if (degreesOfFreedom > kNormal)
        return std::erfc(t / std::sqrt(2.0));
    if (std::isinf(t))
        return 0.0;
    const double sum = degreesOfFreedom + t * t; // Abramowitz and Stegun 1964, 26.7.1
    return regularisedBeta(degreesOfFreedom / sum, t * t / sum, 0.5 * degreesOfFreedom, 0.5);
}

} // namespace lavalight
