// Mean and variance of many samples, put together from parts.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

namespace lavalight {

// The mean of `count` samples, and the sum of their squared differences from it.
struct Moments {
    double mean = 0.0;
    double squares = 0.0;
    uint64_t count = 0;

    // Unbiased estimate of the variance of one sample; 0 for fewer than two samples.
    [[nodiscard]] double variance() const {
        return count > 1 ? squares / static_cast<double>(count - 1) : 0.0;
    }
    // Standard error of the mean.
    [[nodiscard]] double standardError() const {
        return count > 0 ? std::sqrt(variance() / static_cast<double>(count)) : 0.0;
    }
};

// Moments of the samples of both. Chan, Golub, LeVeque, "Updating Formulae and a Pairwise Algorithm for
// Computing Sample Variances", 1979, eq. 2.1.
[[nodiscard]] Moments merged(const Moments& a, const Moments& b);

// Moments of the samples of all parts, merged in their order: the same parts give the same bits.
[[nodiscard]] Moments merged(std::span<const Moments> parts);

// Moments of the numbers in `values`.
[[nodiscard]] Moments momentsOf(std::span<const double> values);

} // namespace lavalight
