#include "compare/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr double kRelMseFloor = 0.01;   // radiance squared, by definition
constexpr double kTrimmedShare = 0.001; // share of the pixels, by definition

void requireSameSize(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error(fmt::format("cannot compare images of different sizes, {} x {} and {} x {}", a.width,
                                a.height, b.width, b.height));
    if (a.pixels.empty())
        throw Error("cannot compare empty images");
}

double sumOf(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

// The pixel's contribution to relMSE: the mean of its channels.
double relativeSquaredError(const glm::dvec3& x, const glm::dvec3& r) {
    const glm::dvec3 difference = x - r;
    return sumOf(difference * difference / (r * r + kRelMseFloor)) / 3.0;
}

glm::dvec3 sumOfPixels(const Image& image) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& pixel : image.pixels)
        sum += glm::dvec3(pixel);
    return sum;
}

double ratioMinusOne(double x, double r) {
    if (r == 0.0)
        return x == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
    return x / r - 1.0;
}

// Calls visit(index) for the pixels of the box of side `size` whose first pixel is (x, y), cut at the image's
// edges.
template <typename Visit>
void forEachInBox(const Image& image, glm::uvec2 first, uint32_t size, const Visit& visit) {
    const uint32_t endX = std::min(image.width, first.x + size);
    const uint32_t endY = std::min(image.height, first.y + size);
    for (uint32_t y = first.y; y < endY; ++y)
        for (uint32_t x = first.x; x < endX; ++x)
            visit(size_t{y} * image.width + x);
}

uint32_t divideUp(uint32_t a, uint32_t b) {
    return (a + b - 1) / b;
}

// Sums over boxes, divided by pixels^power.
Image boxMeans(const Image& source, uint32_t factor, int power) {
    Image result(divideUp(source.width, factor), divideUp(source.height, factor));
    for (uint32_t y = 0; y < result.height; ++y)
        for (uint32_t x = 0; x < result.width; ++x) {
            glm::dvec3 sum(0.0);
            double n = 0.0;
            forEachInBox(source, glm::uvec2(x, y) * factor, factor, [&](size_t i) {
                sum += glm::dvec3(source.pixels[i]);
                n += 1.0;
            });
            result.pixels[size_t{y} * result.width + x] = glm::vec3(sum / (power == 2 ? n * n : n));
        }
    return result;
}

std::vector<uint32_t> boxCounts(const Image& size, const std::vector<uint32_t>& counts, uint32_t factor) {
    std::vector<uint32_t> result;
    for (uint32_t y = 0; y < size.height; y += factor)
        for (uint32_t x = 0; x < size.width; x += factor) {
            uint64_t samples = 0;
            forEachInBox(size, {x, y}, factor, [&](size_t i) { samples += counts[i]; });
            result.push_back(
                static_cast<uint32_t>(std::min<uint64_t>(samples, std::numeric_limits<uint32_t>::max())));
        }
    return result;
}

} // namespace

double rmse(const Image& image, const Image& reference) {
    requireSameSize(image, reference);
    double sum = 0.0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::dvec3 difference = glm::dvec3(image.pixels[i]) - glm::dvec3(reference.pixels[i]);
        sum += sumOf(difference * difference);
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(image.pixels.size())));
}

double relMse(const Image& image, const Image& reference) {
    requireSameSize(image, reference);
    double sum = 0.0;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        sum += relativeSquaredError(image.pixels[i], reference.pixels[i]);
    return sum / static_cast<double>(image.pixels.size());
}

double trimmedRelMse(const Image& image, const Image& reference) {
    requireSameSize(image, reference);
    std::vector<double> errors;
    errors.reserve(image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const double error = relativeSquaredError(image.pixels[i], reference.pixels[i]);
        errors.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity()
                                           : error); // NaN has no order
    }
    const auto trimmed = static_cast<size_t>(kTrimmedShare * static_cast<double>(errors.size()));
    const auto worst = errors.begin() + static_cast<std::ptrdiff_t>(trimmed);
    std::nth_element(errors.begin(), worst, errors.end(), std::greater<>());
    return std::accumulate(worst, errors.end(), 0.0) / static_cast<double>(errors.size() - trimmed);
}

size_t worstOfRelMse(const Image& image, const Image& reference) {
    requireSameSize(image, reference);
    size_t worst = 0;
    double largest = -1.0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const double error = relativeSquaredError(image.pixels[i], reference.pixels[i]);
        if (std::isnan(error))
            return i;
        if (error > largest) {
            largest = error;
            worst = i;
        }
    }
    return worst;
}

MeanDifference relativeMeanDifference(const Image& image, const Image& reference) {
    requireSameSize(image, reference);
    const glm::dvec3 x = sumOfPixels(image);
    const glm::dvec3 r = sumOfPixels(reference);
    return {{ratioMinusOne(x.r, r.r), ratioMinusOne(x.g, r.g), ratioMinusOne(x.b, r.b)},
            ratioMinusOne(sumOf(x), sumOf(r))};
}

uint64_t countNonFinite(const Image& image) {
    const auto count = std::count_if(image.pixels.begin(), image.pixels.end(), [](const glm::vec3& p) {
        return !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
    });
    return static_cast<uint64_t>(count);
}

Rendering downsample(const Rendering& rendering, uint32_t factor) {
    assert(factor > 0 && !rendering.radiance().pixels.empty());
    Rendering result;
    for (const Layer& layer : rendering.layers) {
        requireSameSize(rendering.radiance(), layer.mean);
        Layer& small = result.layers.emplace_back(
            Layer{layer.name, layer.channels, boxMeans(layer.mean, factor, 1), std::nullopt});
        if (!layer.variance)
            continue;
        requireSameSize(rendering.radiance(), *layer.variance);
        small.variance = boxMeans(*layer.variance, factor, 2);
    }
    if (!rendering.sampleCounts.empty())
        result.sampleCounts = boxCounts(rendering.radiance(), rendering.sampleCounts, factor);
    return result;
}

} // namespace lavalight
