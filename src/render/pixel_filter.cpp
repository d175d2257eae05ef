#include "render/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lavalight {
namespace {

// Steps of numeric integration from the middle to the end.
constexpr size_t kSteps = 1u << 14;

float ownRadius(PixelFilter filter) {
    switch (filter) {
    case PixelFilter::box:
        return 0.5f;
    case PixelFilter::tent:
        return 1.0f;
    case PixelFilter::gaussian:
    case PixelFilter::blackmanHarris:
        return 1.5f;
    case PixelFilter::mitchell:
        return 2.0f;
    case PixelFilter::point:
        return 0.0f;
    }
    return 0.5f;
}

// Less its value at the end, so that it has no step there. The standard deviation is a third of the radius.
double gaussian(double x) {
    constexpr double kRadius = 3.0; // standard deviations
    const auto bell = [](double deviations) { return std::exp(-0.5 * deviations * deviations); };
    return bell(kRadius * x) - bell(kRadius);
}

// Source: Harris, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform", 1978,
// the window of four terms and -92 dB.
double blackmanHarris(double x) {
    const double t = std::numbers::pi * (x + 1.0);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2.0 * t) - 0.01168 * std::cos(3.0 * t);
}

// Source: Mitchell, Netravali, "Reconstruction Filters in Computer Graphics", 1988, equation 8 with B = C =
// 1/3.
double mitchell(double x) {
    constexpr double kB = 1.0 / 3.0;
    constexpr double kC = 1.0 / 3.0;
    const double d = 2.0 * x;
    if (d < 1.0)
        return (12.0 - 9.0 * kB - 6.0 * kC) * d * d * d + (-18.0 + 12.0 * kB + 6.0 * kC) * d * d +
               (6.0 - 2.0 * kB);
    return (-kB - 6.0 * kC) * d * d * d + (6.0 * kB + 30.0 * kC) * d * d + (-12.0 * kB - 48.0 * kC) * d +
           (8.0 * kB + 24.0 * kC);
}

} // namespace

float filterRadius(const EstimatorSettings& settings) {
    const bool isOwn = !std::isfinite(settings.filterRadius) || settings.pixelFilter == PixelFilter::point;
    return isOwn ? ownRadius(settings.pixelFilter) : settings.filterRadius;
}

bool isUnitBox(const EstimatorSettings& settings) {
    return settings.pixelFilter == PixelFilter::box && filterRadius(settings) == 0.5f;
}

bool hasNegativeWeights(const EstimatorSettings& settings) {
    return settings.pixelFilter == PixelFilter::mitchell;
}

double filterValue(PixelFilter filter, double x) {
    if (x >= 1.0)
        return 0.0;
    switch (filter) {
    case PixelFilter::box:
    case PixelFilter::point: // a box without size
        return 1.0;
    case PixelFilter::tent:
        return 1.0 - x;
    case PixelFilter::gaussian:
        return gaussian(x);
    case PixelFilter::blackmanHarris:
        return blackmanHarris(x);
    case PixelFilter::mitchell:
        return mitchell(x);
    }
    return 0.0;
}

FilterTable filterTable(const EstimatorSettings& settings) {
    std::vector<double> within(kSteps +
                               1); // integral of the absolute value from the middle, by middles of steps
    double negative = 0.0;
    for (size_t i = 0; i < kSteps; ++i) {
        const double value = filterValue(settings.pixelFilter, (static_cast<double>(i) + 0.5) / kSteps);
        within[i + 1] = within[i] + std::abs(value);
        negative += std::max(0.0, -value);
    }
    FilterTable table;
    const double radius = filterRadius(settings);
    for (size_t i = 0; i <= kFilterIntervals; ++i) {
        const double left = 1.0 - static_cast<double>(i) / kFilterIntervals;
        const double wanted = (1.0 - left * left) * within.back();
        const auto after = std::lower_bound(within.begin() + 1, within.end() - 1, wanted);
        const double before = *(after - 1);
        const double part =
            *after > before ? std::clamp((wanted - before) / (*after - before), 0.0, 1.0) : 1.0;
        table.nodes[i] =
            static_cast<float>(radius * (static_cast<double>(after - 1 - within.begin()) + part) / kSteps);
    }
    table.nodes.back() = static_cast<float>(radius);
    const double share = negative / within.back();
    table.positive = static_cast<float>(1.0 - share);
    table.scale = static_cast<float>(1.0 / ((1.0 - 2.0 * share) * (1.0 - 2.0 * share)));
    return table;
}

} // namespace lavalight
