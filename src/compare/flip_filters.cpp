#include "compare/flip_filters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace lavalight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// 2020, table 1: the Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b) over x in degrees, from Johnson and
// Fairchild 2003.
struct Sensitivity {
    float a;
    float b;
};
constexpr Sensitivity kLuminance{1.0f, 0.0047f};
constexpr Sensitivity kRedGreen{1.0f, 0.0053f};
constexpr Sensitivity kBlueYellowWide{34.1f, 0.04f};
constexpr Sensitivity kBlueYellowNarrow{13.5f, 0.025f};

constexpr float kFeatureWidth = 0.082f; // degrees, of the edge that people detect best (2020, section 4.2)

// Weights below this share of the middle one are no more than rounding, and are left out.
constexpr float kNegligible = 1e-7f;

int radiusOf(float standardDeviations, float sigma) {
    return static_cast<int>(std::ceil(standardDeviations * sigma));
}

void scale(Filter& filter, float factor) {
    for (float& weight : filter.weights)
        weight *= factor;
}

float sumOf(const Filter& filter) {
    float sum = 0.0f;
    for (const float weight : filter.weights)
        sum += weight;
    return sum;
}

// A Gaussian with a middle weight of 1, cut at three standard deviations of the widest one.
Filter gaussian(Sensitivity sensitivity, float pixelsPerDegree) {
    const float widest = std::sqrt(kBlueYellowWide.b / (2.0f * kPi * kPi));
    const int radius = radiusOf(3.0f, widest * pixelsPerDegree);
    Filter filter;
    for (int x = -radius; x <= radius; ++x) {
        const float degrees = static_cast<float>(x) / pixelsPerDegree;
        const float weight = std::exp(-kPi * kPi * degrees * degrees / sensitivity.b);
        if (weight > kNegligible)
            filter.weights.push_back(weight);
    }
    return filter;
}

Filter normalised(Filter filter) {
    scale(filter, 1.0f / sumOf(filter));
    return filter;
}

// The share of a Gaussian in a sum of several, before all are divided by the total.
float volume(Sensitivity sensitivity, const Filter& filter) {
    const float sum = sumOf(filter);
    return sensitivity.a * std::sqrt(kPi / sensitivity.b) * sum * sum;
}

// Scales positive and negative weights apart, each to a sum of 1.
void normaliseSigns(Filter& filter) {
    float positive = 0.0f;
    float negative = 0.0f;
    for (const float weight : filter.weights)
        (weight > 0.0f ? positive : negative) += weight;
    assert(positive > 0.0f && negative < 0.0f);
    for (float& weight : filter.weights)
        weight /= weight > 0.0f ? positive : -negative;
}

} // namespace

ContrastFilters contrastFilters(float pixelsPerDegree) {
    const Filter wide = gaussian(kBlueYellowWide, pixelsPerDegree);
    const Filter narrow = gaussian(kBlueYellowNarrow, pixelsPerDegree);
    const float wideVolume = volume(kBlueYellowWide, wide);
    const float narrowVolume = volume(kBlueYellowNarrow, narrow);
    return {normalised(gaussian(kLuminance, pixelsPerDegree)),
            normalised(gaussian(kRedGreen, pixelsPerDegree)),
            normalised(narrow),
            normalised(wide),
            narrowVolume / (narrowVolume + wideVolume),
            wideVolume / (narrowVolume + wideVolume)};
}

FeatureFilters featureFilters(float pixelsPerDegree) {
    const float sigma = 0.5f * kFeatureWidth * pixelsPerDegree;
    const int radius = radiusOf(3.0f, sigma);
    FeatureFilters filters;
    for (int x = -radius; x <= radius; ++x) {
        const float t = static_cast<float>(x) / sigma;
        const float weight = std::exp(-0.5f * t * t);
        filters.smooth.weights.push_back(weight);
        filters.edge.weights.push_back(-t * weight);
        filters.point.weights.push_back((t * t - 1.0f) * weight);
    }
    filters.smooth = normalised(filters.smooth);
    normaliseSigns(filters.edge);
    normaliseSigns(filters.point);
    return filters;
}

uint32_t flipReach(const ContrastFilters& contrast, const FeatureFilters& features) {
    return static_cast<uint32_t>(std::max(contrast.blueYellowWide.radius(), features.smooth.radius()));
}

Plane filterRows(const Plane& plane, const Filter& filter) {
    const auto width = static_cast<int>(plane.width);
    const int radius = filter.radius();
    Plane result(plane.width, plane.height);
    std::vector<float> extended(static_cast<size_t>(width + 2 * radius));
    for (uint32_t y = 0; y < plane.height; ++y) {
        const float* from = plane.row(y);
        std::fill_n(extended.begin(), radius, from[0]);
        std::copy_n(from, width, extended.begin() + radius);
        std::fill_n(extended.end() - radius, radius, from[width - 1]);
        float* to = result.row(y);
        for (size_t k = 0; k < filter.weights.size(); ++k) {
            const float weight = filter.weights[k];
            const float* shifted = extended.data() + k;
            for (int x = 0; x < width; ++x)
                to[x] += weight * shifted[x];
        }
    }
    return result;
}

Plane filterColumns(const Plane& plane, const Filter& filter) {
    const auto height = static_cast<int>(plane.height);
    const int radius = filter.radius();
    Plane result(plane.width, plane.height);
    for (int y = 0; y < height; ++y) {
        float* to = result.row(static_cast<uint32_t>(y));
        for (int k = -radius; k <= radius; ++k) {
            const float weight = filter.weights[static_cast<size_t>(k) + static_cast<size_t>(radius)];
            const float* from = plane.row(static_cast<uint32_t>(std::clamp(y + k, 0, height - 1)));
            for (uint32_t x = 0; x < plane.width; ++x)
                to[x] += weight * from[x];
        }
    }
    return result;
}

} // namespace lavalight
