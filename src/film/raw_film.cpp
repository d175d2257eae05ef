#include "film/raw_film.h"

#include <algorithm>
#include <numeric>

#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace lavalight {
namespace {

// All planes of some pixels, and the way to one pixel's numbers in them.
class PixelSums {
  public:
    explicit PixelSums(std::span<const uint32_t> planes)
        : planes_(planes), pixels_(planes.size() / kFilmWords) {}

    [[nodiscard]] size_t pixels() const { return pixels_; }
    [[nodiscard]] uint32_t count(size_t pixel) const { return planes_[kCountPlane * pixels_ + pixel]; }
    [[nodiscard]] PixelEstimate channel(size_t pixel, uint32_t channel) const {
        const uint32_t plane = channel * kChannelWords;
        return estimate(value<kSumWords>(pixel, plane, kSumLowestExponent),
                        value<kSquareWords>(pixel, plane + kSumWords, kSquareLowestExponent), count(pixel));
    }

  private:
    template <uint32_t Words>
    [[nodiscard]] double value(size_t pixel, uint32_t plane, int lowestExponent) const {
        std::array<uint32_t, Words> words;
        for (uint32_t i = 0; i < Words; ++i)
            words[i] = planes_[(plane + i) * pixels_ + pixel];
        return fromFixed(words, lowestExponent);
    }

    std::span<const uint32_t> planes_;
    size_t pixels_;
};

// Numbers of several words, one word of all pixels after the other.
struct NumberPlanes {
    uint32_t firstPlane;
    uint32_t words;
};

// As the kernels add (shaders/lib/fixed_point.glsl): what leaves the range stays at its largest value.
// Returns how many of the sums are there.
uint64_t addNumbers(RawFilm& sum, const RawFilm& more, NumberPlanes number) {
    const size_t pixels = sum.pixels();
    uint64_t saturated = 0;
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        uint64_t carry = 0;
        bool isLargest = true;
        const auto at = [&](uint32_t word) { return (number.firstPlane + word) * pixels + pixel; };
        for (uint32_t word = 0; word < number.words; ++word) {
            carry += uint64_t{sum.words[at(word)]} + more.words[at(word)];
            sum.words[at(word)] = static_cast<uint32_t>(carry);
            isLargest = isLargest && sum.words[at(word)] == 0xffffffffu;
            carry >>= 32;
        }
        for (uint32_t word = 0; carry != 0 && word < number.words; ++word)
            sum.words[at(word)] = 0xffffffffu;
        saturated += carry != 0 || isLargest ? 1 : 0;
    }
    return saturated;
}

} // namespace

uint64_t RawFilm::samples() const {
    const auto counts = words.begin() + static_cast<ptrdiff_t>(kCountPlane * pixels());
    return std::accumulate(counts, words.end(), uint64_t{0});
}

std::string samplesPerPixel(uint64_t samples, uint64_t pixels) {
    return fmt::format("{:.6g}", static_cast<double>(samples) / static_cast<double>(pixels));
}

FilmTallies readable(const RawTallies& counts) {
    FilmTallies tallies;
    tallies.droppedSamples = counts[kTallyDropped];
    tallies.saturatedSums = counts[kTallySaturated];
    tallies.cutPaths = counts[kTallyCutPaths];
    const double throughput = static_cast<double>(counts[kTallyCutThroughput]) / 65536.0;
    tallies.cutThroughput = tallies.cutPaths > 0 ? throughput / static_cast<double>(tallies.cutPaths) : 0.0;
    tallies.overlaps = counts[kTallyOverlaps];
    const auto pair = static_cast<uint32_t>(counts[kTallyOverlapPair]);
    tallies.overlapping = {pair >> 16, pair & 0xffffu};
    return tallies;
}

void add(RawFilm& sum, const RawFilm& more) {
    assert(sum.width == more.width && sum.height == more.height);
    uint64_t saturated = 0;
    for (uint32_t channel = 0; channel < 3; ++channel) {
        const uint32_t plane = channel * kChannelWords;
        saturated += addNumbers(sum, more, {plane, kSumWords});
        saturated += addNumbers(sum, more, {plane + kSumWords, kSquareWords});
    }
    const size_t firstCount = kCountPlane * sum.pixels();
    for (size_t i = firstCount; i < firstCount + sum.pixels(); ++i)
        sum.words[i] += more.words[i];
    const uint64_t pair = std::max(sum.tallies[kTallyOverlapPair], more.tallies[kTallyOverlapPair]);
    for (size_t i = 0; i < kTallyCount; ++i)
        sum.tallies[i] += more.tallies[i];
    sum.tallies[kTallyOverlapPair] = pair;    // the kernels keep the greatest
    sum.tallies[kTallySaturated] = saturated; // the same sums may be saturated in both
}

void resolvePixels(std::span<const uint32_t> planes, size_t firstPixel, Rendering& rendering) {
    const PixelSums sums(planes);
    for (size_t pixel = 0; pixel < sums.pixels(); ++pixel) {
        rendering.sampleCounts[firstPixel + pixel] = sums.count(pixel);
        for (uint32_t channel = 0; channel < 3; ++channel) {
            const PixelEstimate e = sums.channel(pixel, channel);
            const auto at = static_cast<glm::length_t>(channel);
            rendering.radiance.pixels[firstPixel + pixel][at] = static_cast<float>(e.mean);
            rendering.variance.pixels[firstPixel + pixel][at] = static_cast<float>(e.varianceOfMean);
        }
    }
}

Rendering resolve(const RawFilm& film) {
    Rendering rendering{Image(film.width, film.height), Image(film.width, film.height),
                        std::vector<uint32_t>(film.pixels())};
    resolvePixels(film.words, 0, rendering);
    return rendering;
}

double fromFixed(std::span<const uint32_t> words, int lowestExponent) {
    double value = 0.0;
    for (size_t i = words.size(); i-- > 0;)
        value += std::ldexp(static_cast<double>(words[i]), lowestExponent + 32 * static_cast<int>(i));
    return value;
}

PixelEstimate estimate(double sum, double sumOfSquares, uint32_t count) {
    if (count == 0)
        return {};
    const double n = count;
    const double mean = sum / n;
    if (count == 1)
        return {mean, 0.0};
    return {mean, std::max(0.0, sumOfSquares / n - mean * mean) / (n - 1.0)};
}

} // namespace lavalight
