#include "render/film.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "gpu/commands.h"

namespace lavalight {
namespace {

uint32_t rowsPerBand(const gpu::Device& device, uint32_t width, uint32_t height, uint32_t wanted) {
    const uint64_t bytesPerRow = uint64_t{width} * kFilmWords * sizeof(uint32_t);
    const auto most = static_cast<uint32_t>(
        std::min<uint64_t>(device.limits().maxStorageBufferBytes / bytesPerRow, height));
    if (most == 0)
        throw Error(fmt::format("an image row of {} pixels does not fit into a storage buffer of {}", width,
                                device.description().name));
    return wanted == 0 ? most : std::min(wanted, most);
}

uint64_t pairOfWords(std::span<const uint32_t> words, uint32_t which) {
    return uint64_t{words[2 * which + 1]} << 32 | words[2 * which];
}

// All planes of a band, and the way to one pixel's numbers in them.
class BandWords {
  public:
    explicit BandWords(const FilmBand& band)
        : words_(band.sums.downloadAll<uint32_t>()), pixels_(words_.size() / kFilmWords) {}

    [[nodiscard]] size_t pixels() const { return pixels_; }
    [[nodiscard]] uint32_t count(size_t pixel) const { return words_[kCountPlane * pixels_ + pixel]; }
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
            words[i] = words_[(plane + i) * pixels_ + pixel];
        return fromFixed(words, lowestExponent);
    }

    std::vector<uint32_t> words_;
    size_t pixels_;
};

} // namespace

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

Film::Film(gpu::Device& device, uint32_t width, uint32_t height, uint32_t bandRows)
    : device_(&device), width_(width), height_(height),
      tallies_(device, "film tallies", 2 * kTallyCount * sizeof(uint32_t), gpu::BufferUse::readback) {
    const uint32_t rows = rowsPerBand(device, width, height, bandRows);
    for (uint32_t first = 0; first < height; first += rows) {
        const uint32_t here = std::min(rows, height - first);
        const uint64_t bytes = uint64_t{here} * width * kFilmWords * sizeof(uint32_t);
        bands_.push_back({first, here, gpu::Buffer(device, "film", bytes, gpu::BufferUse::storage)});
    }
    clear();
}

void Film::clear() {
    gpu::Commands commands(*device_);
    commands.begin();
    for (const FilmBand& band : bands_)
        commands.fill(band.sums, 0);
    commands.fill(tallies_, 0);
    commands.submitAndWait();
}

Rendering Film::resolve() const {
    Rendering rendering{Image(width_, height_), Image(width_, height_),
                        std::vector<uint32_t>(size_t{width_} * height_)};
    for (const FilmBand& band : bands_) {
        const BandWords words(band);
        const size_t first = size_t{band.firstRow} * width_;
        for (size_t pixel = 0; pixel < words.pixels(); ++pixel) {
            rendering.sampleCounts[first + pixel] = words.count(pixel);
            for (uint32_t channel = 0; channel < 3; ++channel) {
                const PixelEstimate e = words.channel(pixel, channel);
                const auto at = static_cast<glm::length_t>(channel);
                rendering.radiance.pixels[first + pixel][at] = static_cast<float>(e.mean);
                rendering.variance.pixels[first + pixel][at] = static_cast<float>(e.varianceOfMean);
            }
        }
    }
    return rendering;
}

FilmTallies Film::readTallies() const {
    const std::vector<uint32_t> words = tallies_.downloadAll<uint32_t>();
    FilmTallies tallies;
    tallies.droppedSamples = pairOfWords(words, kTallyDropped);
    tallies.saturatedSums = pairOfWords(words, kTallySaturated);
    tallies.cutPaths = pairOfWords(words, kTallyCutPaths);
    const double throughput = static_cast<double>(pairOfWords(words, kTallyCutThroughput)) / 65536.0;
    tallies.cutThroughput = tallies.cutPaths > 0 ? throughput / static_cast<double>(tallies.cutPaths) : 0.0;
    tallies.overlaps = pairOfWords(words, kTallyOverlaps);
    const auto pair = static_cast<uint32_t>(pairOfWords(words, kTallyOverlapPair));
    tallies.overlapping = {pair >> 16, pair & 0xffffu};
    return tallies;
}

} // namespace lavalight
