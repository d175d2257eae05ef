#include "compare/welch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/distributions/students_t.hpp>

#include "base/error.h"

namespace lavalight {
namespace {

// Share of the reference's value by which the functions of another driver, exact to 2^-11 at worst (Vulkan's
// sine), may change the mean of many paths.
constexpr double kRounding = 1e-4;

void requireSameSize(const Image& a, const Image* b) {
    if (b != nullptr && (a.width != b->width || a.height != b->height))
        throw Error("cannot test images of different sizes");
}

bool canBeTested(const Estimate& e, size_t pixel) {
    return e.variance == nullptr || e.sampleCounts.empty() || e.sampleCounts[pixel] >= 2;
}

// Variance of a difference, and the sum(v^2 / degrees of freedom) of the estimates v that it is the sum of.
struct Uncertainty {
    glm::dvec3 variance{0.0};
    glm::dvec3 spread{0.0};
};

double samplesOf(const Estimate& e, size_t pixel) {
    const bool areCounted = e.variance != nullptr && !e.sampleCounts.empty();
    return areCounted ? e.sampleCounts[pixel] : std::numeric_limits<double>::infinity();
}

glm::dvec3 varianceOf(const Estimate& e, size_t pixel) {
    return e.variance == nullptr ? glm::dvec3(0.0) : glm::dvec3(e.variance->pixels[pixel]);
}

// Welch's sum of both variances or, where larger, Student's, for which a sample of either varies alike: few
// samples that all missed a rare path know nothing of its variance, but the many of the other image do. With
// equal numbers of samples both are one.
Uncertainty uncertaintyOf(const Estimate& image, const Estimate& reference, size_t pixel) {
    const double n = samplesOf(image, pixel);
    const double m = samplesOf(reference, pixel);
    const glm::dvec3 v = varianceOf(image, pixel);
    const glm::dvec3 w = varianceOf(reference, pixel);
    Uncertainty u{v + w, v * v / (n - 1.0) + w * w / (m - 1.0)};
    if (n == m || std::isinf(n) || std::isinf(m))
        return u;
    const glm::dvec3 perSample = ((n - 1.0) * n * v + (m - 1.0) * m * w) / (n + m - 2.0);
    const glm::dvec3 pooled = perSample * (1.0 / n + 1.0 / m);
    for (int c = 0; c < 3; ++c)
        if (pooled[c] > u.variance[c]) {
            u.variance[c] = pooled[c];
            u.spread[c] = pooled[c] * pooled[c] / (n + m - 2.0);
        }
    return u;
}

TileDifference tileDifference(const Estimate& image, const Estimate& reference, glm::uvec2 first,
                              uint32_t size) {
    const uint32_t width = image.mean->width;
    const uint32_t endX = std::min(width, first.x + size);
    const uint32_t endY = std::min(image.mean->height, first.y + size);
    TileDifference tile{first};
    for (uint32_t y = first.y; y < endY; ++y)
        for (uint32_t x = first.x; x < endX; ++x) {
            const size_t i = size_t{y} * width + x;
            if (!canBeTested(image, i) || !canBeTested(reference, i))
                continue;
            const glm::dvec3 r(reference.mean->pixels[i]);
            tile.difference += glm::dvec3(image.mean->pixels[i]) - r;
            tile.reference += r;
            tile.imageVariance += varianceOf(image, i);
            tile.referenceVariance += varianceOf(reference, i);
            const Uncertainty u = uncertaintyOf(image, reference, i);
            tile.variance += u.variance;
            tile.spread += u.spread;
        }
    return tile;
}

// The probability of a value beyond -t or t; degrees of freedom may be infinite.
double studentTwoSidedTail(double t, double degreesOfFreedom) {
    using namespace boost::math::policies;
    // Figures without an answer give NaN, which is below no limit.
    using Policy = policy<promote_double<false>, domain_error<ignore_error>, overflow_error<ignore_error>,
                          evaluation_error<ignore_error>>;
    const boost::math::students_t_distribution<double, Policy> distribution(degreesOfFreedom);
    return 2.0 * cdf(complement(distribution, t));
}

// The p-value of a test; any above `atLeast` may come out as `atLeast`. Student's tails are no lighter than
// the normal distribution's, which takes a tenth of their time and settles nearly all tests.
double pValue(const TileDifference& tile, int c, double z, double atLeast) {
    if (std::abs(tile.difference[c]) <= kRounding * std::abs(tile.reference[c]))
        return 1.0;
    if (std::isinf(z))
        return 0.0;
    if (std::erfc(z / std::numbers::sqrt2) > atLeast)
        return atLeast;
    const double squared = tile.variance[c] * tile.variance[c];
    const double spread = tile.spread[c];
    return studentTwoSidedTail(z, spread > 0.0 ? squared / spread : std::numeric_limits<double>::infinity());
}

} // namespace

double WelchTest::fractionBelow(float limit) const {
    const auto below = std::count_if(absZ.begin(), absZ.end(), [&](float z) { return z < limit; });
    return static_cast<double>(below) / static_cast<double>(absZ.size());
}

bool hasTestablePixel(const Estimate& image, const Estimate& reference) {
    for (size_t i = 0; i < image.mean->pixels.size(); ++i)
        if (canBeTested(image, i) && canBeTested(reference, i))
            return true;
    return false;
}

std::vector<TileDifference> tileDifferences(const Estimate& image, const Estimate& reference,
                                            uint32_t tileSize) {
    assert(tileSize > 0 && image.mean != nullptr && reference.mean != nullptr);
    requireSameSize(*image.mean, reference.mean);
    requireSameSize(*image.mean, image.variance);
    requireSameSize(*image.mean, reference.variance);
    if (image.mean->pixels.empty())
        throw Error("cannot test empty images");
    std::vector<TileDifference> tiles;
    for (uint32_t y = 0; y < image.mean->height; y += tileSize)
        for (uint32_t x = 0; x < image.mean->width; x += tileSize)
            tiles.push_back(tileDifference(image, reference, {x, y}, tileSize));
    return tiles;
}

double absoluteZ(double difference, double deviation) {
    if (difference == 0.0)
        return 0.0;
    const double z = std::abs(difference) / deviation;
    return std::isnan(z) ? std::numeric_limits<double>::infinity() : z;
}

WelchTest welchTest(const Estimate& image, const Estimate& reference, uint32_t tileSize) {
    WelchTest result;
    double smallest = 2.0; // above every p
    for (const TileDifference& tile : tileDifferences(image, reference, tileSize))
        for (int c = 0; c < 3; ++c) {
            const double z = absoluteZ(tile.difference[c], std::sqrt(tile.variance[c]));
            result.absZ.push_back(static_cast<float>(z));
            result.maxAbsZ = std::max(result.maxAbsZ, result.absZ.back());
            const double p = pValue(tile, c, z, smallest);
            if (p < smallest || (p == 0.0 && z > result.worstAbsZ)) {
                smallest = p;
                result.worstTile = tile.first;
                result.worstChannel = c;
                result.worstAbsZ = result.absZ.back();
            }
        }
    result.p = std::min(1.0, smallest * static_cast<double>(result.absZ.size()));
    return result;
}

} // namespace lavalight
