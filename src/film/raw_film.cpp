#include "film/raw_film.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "base/parallel.h"
#include "film/film_shadow.h"

namespace lavalight {
namespace {

// Without samples, 0.
double meanOf(double sum, double count) {
    return count == 0.0 ? 0.0 : sum / count;
}

// The word planes of some pixels, and the way to one pixel's numbers in them.
class PixelSums {
  public:
    PixelSums(std::span<const uint32_t> words, const FilmLayout& layout)
        : words_(words), pixels_(words.size() / layout.words()), countWord_(layout.countWord()) {}

    [[nodiscard]] size_t pixels() const { return pixels_; }
    [[nodiscard]] uint32_t count(size_t pixel) const { return words_[countWord_ * pixels_ + pixel]; }
    // A sum without squares or sign.
    [[nodiscard]] double sum(size_t pixel, uint32_t firstWord) const {
        return fromFixed(number<kSumWords>(pixel, firstWord), kSumLowestExponent);
    }
    // The estimate of the component whose words begin with `firstWord`; a mean over `count` without squares.
    [[nodiscard]] PixelEstimate component(size_t pixel, uint32_t firstWord, const FilmPlane& shape,
                                          double counted) const {
        const double sum = shape.isSigned != 0
                               ? fromSigned(number<kSignedSumWords>(pixel, firstWord), kSumLowestExponent)
                               : fromFixed(number<kSumWords>(pixel, firstWord), kSumLowestExponent);
        if (shape.hasSquares == 0)
            return {meanOf(sum, counted), 0.0};
        const auto square = number<kSquareWords>(pixel, firstWord + sumWordsOf(shape));
        return estimate(sum, fromFixed(square, kSquareLowestExponent), count(pixel));
    }

  private:
    template <uint32_t Words>
    [[nodiscard]] std::array<uint32_t, Words> number(size_t pixel, uint32_t firstWord) const {
        std::array<uint32_t, Words> number;
        for (uint32_t i = 0; i < Words; ++i)
            number[i] = words_[(firstWord + i) * pixels_ + pixel];
        return number;
    }

    std::span<const uint32_t> words_;
    size_t pixels_;
    uint32_t countWord_;
};

// Adds as the kernels do (shaders/lib/film/fixed_point.glsl): what leaves the range of numbers without sign
// stays at the largest value, and numbers in two's complement have room for all samples that can be counted.
// Returns how many of the sums are at the largest value.
uint64_t addNumbers(RawFilm& sum, const RawFilm& more, const FilmNumber& number) {
    const size_t pixels = sum.pixels();
    uint64_t saturated = 0;
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        uint64_t carry = 0;
        bool isLargest = true;
        const auto at = [&](uint32_t word) { return (number.firstWord + word) * pixels + pixel; };
        for (uint32_t word = 0; word < number.words; ++word) {
            carry += uint64_t{sum.words[at(word)]} + more.words[at(word)];
            sum.words[at(word)] = static_cast<uint32_t>(carry);
            isLargest = isLargest && sum.words[at(word)] == 0xffffffffu;
            carry >>= 32;
        }
        if (number.isSigned) // the carry is the sign's, and -1 is no largest value
            continue;
        for (uint32_t word = 0; carry != 0 && word < number.words; ++word)
            sum.words[at(word)] = 0xffffffffu;
        saturated += carry != 0 || isLargest ? 1 : 0;
    }
    return saturated;
}

} // namespace

std::vector<IdLayer> emptyIds(const FilmLayout& layout, size_t pixels) {
    std::vector<IdLayer> layers;
    for (const std::string& name : layout.idLayers())
        layers.push_back({name, IdCounts(pixels)});
    return layers;
}

uint64_t RawFilm::samples() const {
    return totalOf(std::span(words).subspan(layout.countWord() * pixels()));
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
    tallies.crowdedPaths = counts[kTallyCrowded];
    tallies.crowdedSolid = static_cast<uint32_t>(counts[kTallyCrowdedSolid]);
    tallies.negativeSamples = counts[kTallyNegative];
    tallies.limitedValues = counts[kTallyLimited];
    return tallies;
}

void add(RawFilm& sum, const RawFilm& more) {
    assert(sum.width == more.width && sum.height == more.height && sum.layout == more.layout);
    uint64_t saturated = 0;
    for (const FilmNumber& number : sum.layout.numbers())
        saturated += addNumbers(sum, more, number);
    for (size_t i = sum.layout.countWord() * sum.pixels(); i < sum.words.size(); ++i)
        sum.words[i] += more.words[i];
    const uint64_t solid = std::max(sum.tallies[kTallyCrowdedSolid], more.tallies[kTallyCrowdedSolid]);
    for (size_t i = 0; i < kTallyCount; ++i)
        sum.tallies[i] += more.tallies[i];
    sum.tallies[kTallyCrowdedSolid] = solid;  // the kernels keep the greatest
    sum.tallies[kTallySaturated] = saturated; // the two films may share saturated sums
    for (size_t i = 0; i < sum.ids.size(); ++i)
        for (size_t pixel = 0; pixel < sum.pixels(); ++pixel)
            for (const IdCount& counted : more.ids[i].counts.ranked(pixel))
                sum.ids[i].counts.add(pixel, counted.id, counted.count);
}

Rendering emptyRendering(const FilmLayout& layout, uint32_t width, uint32_t height, uint32_t rows) {
    const auto isWanted = [&](const LayerPlane& plane) {
        for (uint32_t row = 0; row < kFilmPlaneCount; ++row)
            if (plane.name == planeName(row))
                return (rows >> row & 1u) != 0;
        return true; // a plane that only its file knows
    };
    Rendering rendering;
    for (const LayerPlane& plane : layout.planes()) {
        if (!isWanted(plane))
            continue;
        Layer& layer = rendering.layers.emplace_back(
            Layer{plane.name, plane.channels, Image(width, height), std::nullopt});
        if (plane.hasSquares())
            layer.variance.emplace(width, height);
    }
    rendering.sampleCounts.resize(size_t{width} * height);
    return rendering;
}

namespace {

// Estimates of the pixels from `first` to before `end`.
void resolveRange(const PixelSums& sums, const FilmLayout& layout, size_t firstPixel, size_t first,
                  size_t end, Rendering& rendering) {
    for (size_t pixel = first; pixel < end; ++pixel)
        rendering.sampleCounts[firstPixel + pixel] = sums.count(pixel);
    for (size_t plane = 0; plane < layout.planes().size(); ++plane) {
        const FilmPlane& shape = layout.planes()[plane].shape;
        const auto found =
            std::find_if(rendering.layers.begin(), rendering.layers.end(),
                         [&](const Layer& layer) { return layer.name == layout.planes()[plane].name; });
        if (found == rendering.layers.end())
            continue;
        Layer& layer = *found;
        // Negative lobes of a pixel filter lead out of it.
        const bool isShare = layer.name == kCoverageLayer;
        const std::optional<size_t> hits =
            layout.planes()[plane].isPerHit() ? layout.find(kHitsPlane) : std::nullopt;
        for (size_t pixel = first; pixel < end; ++pixel)
            for (uint32_t c = 0; c < shape.components; ++c) {
                const uint32_t word = layout.firstWord(plane) + c * componentWordsOf(shape);
                const double counted = hits ? sums.sum(pixel, layout.firstWord(*hits)) : sums.count(pixel);
                const PixelEstimate e = sums.component(pixel, word, shape, counted);
                const auto at = static_cast<glm::length_t>(c);
                layer.mean.pixels[firstPixel + pixel][at] =
                    static_cast<float>(isShare ? std::clamp(e.mean, 0.0, 1.0) : e.mean);
                if (layer.variance)
                    layer.variance->pixels[firstPixel + pixel][at] = static_cast<float>(e.varianceOfMean);
            }
    }
    castShadows(rendering, firstPixel + first, end - first);
}

} // namespace

void resolvePixels(std::span<const uint32_t> words, const FilmLayout& layout, size_t firstPixel,
                   Rendering& rendering) {
    const PixelSums sums(words, layout);
    constexpr size_t kBlock = 8192; // pixels, a fraction of a millisecond
    forEachInParallel((sums.pixels() + kBlock - 1) / kBlock, [&](size_t block) {
        resolveRange(sums, layout, firstPixel, block * kBlock, std::min((block + 1) * kBlock, sums.pixels()),
                     rendering);
    });
}

Rendering resolve(const RawFilm& film) {
    Rendering rendering = emptyRendering(film.layout, film.width, film.height);
    resolvePixels(film.words, film.layout, 0, rendering);
    return rendering;
}

double fromFixed(std::span<const uint32_t> words, int lowestExponent) {
    double value = 0.0;
    double unit = std::ldexp(1.0, lowestExponent + 32 * static_cast<int>(words.size()));
    for (size_t i = words.size(); i-- > 0;) {
        unit *= 0x1p-32;
        value += unit * words[i]; // the product is exact
    }
    return value;
}

// The words are made positive first: the sum of a large negative word and large positive ones would round.
double fromSigned(std::span<const uint32_t> words, int lowestExponent) {
    if ((words.back() & 0x80000000u) == 0)
        return fromFixed(words, lowestExponent);
    std::array<uint32_t, kSignedSumWords> opposite;
    assert(words.size() <= opposite.size());
    uint64_t carry = 1;
    for (size_t i = 0; i < words.size(); ++i) {
        carry += uint32_t{~words[i]};
        opposite[i] = static_cast<uint32_t>(carry);
        carry >>= 32;
    }
    return -fromFixed(std::span(opposite).first(words.size()), lowestExponent);
}

PixelEstimate estimate(double sum, double sumOfSquares, uint32_t count) {
    const double mean = meanOf(sum, count);
    if (count < 2)
        return {mean, 0.0};
    const double n = count;
    return {mean, std::max(0.0, sumOfSquares / n - mean * mean) / (n - 1.0)};
}

} // namespace lavalight
