// The numbers of sections and equations are those of the publication of 2020, where no other is named.
#include "compare/flip.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <thread>

#include <fmt/format.h>

#include "base/error.h"
#include "compare/flip_colours.h"
#include "compare/flip_filters.h"

namespace lavalight {
namespace {

// Distance and width of the screen are equal, so a degree is the share pi/180 of its 3840 pixels.
constexpr float kPixelsPerDegree = 3840.0f * std::numbers::pi_v<float> / 180.0f;

constexpr float kColourExponent = 0.7f; // qc of section 4.1.4
constexpr float kCompressionStart =
    0.4f;                            // pc: the share of the largest difference that is mapped to kCompressed
constexpr float kCompressed = 0.95f; // pt
constexpr float kFeatureExponent = 0.5f; // qf of section 4.2

constexpr uint32_t kStripRows =
    64; // computed at once, with the rows that filters reach beyond: they stay in caches

struct Filters {
    ContrastFilters contrast = contrastFilters(kPixelsPerDegree);
    FeatureFilters features = featureFilters(kPixelsPerDegree);
    float largestDifference = std::pow(largestColourDifference(), kColourExponent);
};

// Rows first to before end of the two images, extended by what filters reach.
struct Strip {
    uint32_t first;
    uint32_t end;
    uint32_t from;
    uint32_t to;
};

using Channels = std::array<Plane, 3>;

// Linear values of a strip on the display, in [0, 1], in YCxCz.
Channels opponentPlanes(const Image& image, const Strip& strip, const DisplayValue& display) {
    const uint32_t rows = strip.to - strip.from;
    Channels planes{Plane(image.width, rows), Plane(image.width, rows), Plane(image.width, rows)};
    const glm::vec3* pixels = image.pixels.data() + size_t{strip.from} * image.width;
    for (size_t i = 0; i < planes[0].values.size(); ++i) {
        const glm::vec3 opponent = opponentFromLinear(display(pixels[i]));
        for (int c = 0; c < 3; ++c)
            planes[static_cast<size_t>(c)].values[i] = opponent[c];
    }
    return planes;
}

Plane blur(const Plane& plane, const Filter& filter) {
    return filterColumns(filterRows(plane, filter), filter);
}

// What an eye resolves of the colours (section 4.1.1), as L*a*b* with Hunt's adjustment (4.1.2).
std::vector<glm::vec3> perceivedColours(const Channels& planes, const ContrastFilters& filters) {
    const Plane y = blur(planes[0], filters.luminance);
    const Plane x = blur(planes[1], filters.redGreen);
    const Plane narrow = blur(planes[2], filters.blueYellowNarrow);
    const Plane wide = blur(planes[2], filters.blueYellowWide);
    std::vector<glm::vec3> colours(y.values.size());
    for (size_t i = 0; i < colours.size(); ++i) {
        const float z = filters.narrowShare * narrow.values[i] + filters.wideShare * wide.values[i];
        const glm::vec3 linear = linearFromOpponent({y.values[i], x.values[i], z});
        colours[i] = huntAdjustedLab(glm::clamp(linear, 0.0f, 1.0f));
    }
    return colours;
}

struct Features {
    Plane edges;
    Plane points;
};

Plane magnitudes(const Plane& x, const Plane& y) {
    Plane result(x.width, x.height);
    for (size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
    return result;
}

// How much of an edge and of a point there is at each pixel of the luminance (section 4.2).
Features findFeatures(const Plane& opponentLuminance, const FeatureFilters& filters) {
    Plane luminance = opponentLuminance;
    for (float& value : luminance.values)
        value = (value + 16.0f) / 116.0f; // luminance of YCxCz, to [0, 1]
    const Plane smooth = filterRows(luminance, filters.smooth);
    return {magnitudes(filterColumns(filterRows(luminance, filters.edge), filters.smooth),
                       filterColumns(smooth, filters.edge)),
            magnitudes(filterColumns(filterRows(luminance, filters.point), filters.smooth),
                       filterColumns(smooth, filters.point))};
}

// The error of a difference in colour (section 4.1.4): large ones share what kCompressed leaves of the range.
float colourError(float difference, float largest) {
    const float raised = std::pow(difference, kColourExponent);
    const float start = kCompressionStart * largest;
    if (raised < start)
        return raised * kCompressed / start;
    return kCompressed + (raised - start) / (largest - start) * (1.0f - kCompressed);
}

// Displays both images at one exposure and raises the strip's errors to those that it shows.
void raiseErrors(const Image& image, const Image& reference, const Strip& strip, const DisplayValue& display,
                 const Filters& filters, std::vector<float>& errors) {
    const Channels a = opponentPlanes(image, strip, display);
    const Channels b = opponentPlanes(reference, strip, display);
    const std::vector<glm::vec3> coloursA = perceivedColours(a, filters.contrast);
    const std::vector<glm::vec3> coloursB = perceivedColours(b, filters.contrast);
    const Features featuresA = findFeatures(a[0], filters.features);
    const Features featuresB = findFeatures(b[0], filters.features);
    const size_t skipped = size_t{strip.first - strip.from} * image.width;
    const size_t count = size_t{strip.end - strip.first} * image.width;
    float* result = errors.data() + size_t{strip.first} * image.width;
    for (size_t k = 0; k < count; ++k) {
        const size_t i = skipped + k;
        const float colour =
            colourError(colourDifference(coloursA[i], coloursB[i]), filters.largestDifference);
        const float feature = std::max(std::abs(featuresA.edges.values[i] - featuresB.edges.values[i]),
                                       std::abs(featuresA.points.values[i] - featuresB.points.values[i]));
        const float seen = std::pow(feature * std::numbers::sqrt2_v<float> / 2.0f, kFeatureExponent);
        result[k] = std::max(result[k], std::pow(colour, 1.0f - std::min(seen, 1.0f))); // section 4.3
    }
}

void requireComparable(const Image& image, const Image& reference) {
    if (image.width != reference.width || image.height != reference.height || image.pixels.empty())
        throw Error(fmt::format("cannot compare images of {} x {} and {} x {} pixels", image.width,
                                image.height, reference.width, reference.height));
}

// Calls work(strip) for all strips of an image, on all processors.
void forEachStrip(const Image& image, uint32_t reach, const std::function<void(const Strip&)>& work) {
    const uint32_t strips = (image.height + kStripRows - 1) / kStripRows;
    std::atomic<uint32_t> next = 0;
    const auto run = [&] {
        for (uint32_t i = next++; i < strips; i = next++) {
            const uint32_t first = i * kStripRows;
            const uint32_t end = std::min(first + kStripRows, image.height);
            work({first, end, first - std::min(first, reach), std::min(end + reach, image.height)});
        }
    };
    std::vector<std::jthread> threads;
    for (uint32_t i = 1; i < std::min(strips, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back(run);
    run();
}

// The largest error over several ways to display both images.
FlipMap largestErrors(const Image& image, const Image& reference, std::span<const DisplayValue> displays) {
    requireComparable(image, reference);
    const Filters filters;
    FlipMap map{image.width, image.height, std::vector<float>(image.pixels.size(), 0.0f)};
    forEachStrip(image, flipReach(filters.contrast, filters.features), [&](const Strip& strip) {
        for (const DisplayValue& display : displays)
            raiseErrors(image, reference, strip, display, filters, map.errors);
    });
    return map;
}

} // namespace

double FlipMap::mean() const {
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

size_t FlipMap::worst() const {
    return static_cast<size_t>(std::max_element(errors.begin(), errors.end()) - errors.begin());
}

FlipMap flip(const Image& image, const Image& reference) {
    const std::array<DisplayValue, 1> displays{DisplayValue()};
    return largestErrors(image, reference, displays);
}

ExposureRange exposureRange(const Image& reference) {
    std::vector<float> luminances;
    luminances.reserve(reference.pixels.size());
    for (const glm::vec3& pixel : reference.pixels)
        luminances.push_back(luminance(nonNegative(pixel)));
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    constexpr float kDarkest = std::numeric_limits<float>::epsilon(); // black has no exposure
    const float median = std::max(*middle, kDarkest);
    const float brightest = std::max(*std::max_element(middle, luminances.end()), kDarkest);
    ExposureRange range{std::log2(acesNearlyWhite() / brightest), std::log2(acesNearlyWhite() / median)};
    range.count = std::max(2u, static_cast<uint32_t>(std::ceil(range.stop - range.start)));
    return range;
}

FlipMap flipOfRadiance(const Image& image, const Image& reference) {
    requireComparable(image, reference);
    const ExposureRange range = exposureRange(reference);
    std::vector<DisplayValue> displays;
    for (uint32_t i = 0; i < range.count; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(range.count - 1);
        displays.push_back(DisplayValue(std::exp2(range.start + share * (range.stop - range.start))));
    }
    return largestErrors(image, reference, displays);
}

} // namespace lavalight
