// The exact sums of a film in the host's memory, where they are stored, joined, and turned into an image.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/film_layout.h"
#include "film/id_counts.h"
#include "image/rendering.h"
#include "shared/film.h"
#include "shared/interior_list.h"

namespace lavalight {

// Solids that a path keeps count of at a time.
constexpr uint32_t kMostNestedSolids = kInteriorEntries;
// The number that all solids from there on have in the kernels.
constexpr uint32_t kUnnamedSolid = kLastSolid;

// Events that the ledger reports, counted by the kernels.
struct FilmTallies {
    uint64_t droppedSamples = 0; // NaN or infinity
    uint64_t saturatedSums = 0;
    uint64_t cutPaths = 0;        // ended by --max-bounces while they carried light
    double cutThroughput = 0.0;   // mean over the cut paths
    uint64_t crowdedPaths = 0;    // within more solids at once than a path keeps count of
    uint32_t crowdedSolid = 0;    // number of one of these
    uint64_t negativeSamples = 0; // below 0 in a plane without sign, where they counted as 0
    uint64_t limitedValues = 0;   // values limited to the film's range in planes with sign
};

// Counts as the kernels keep them, by kTally...
using RawTallies = std::array<uint64_t, kTallyCount>;

[[nodiscard]] FilmTallies readable(const RawTallies& tallies);

// What a layer of ids is made of.
struct IdLayer {
    std::string name;
    IdCounts counts;
};
// Empty counts for each of the layout's layers of ids.
[[nodiscard]] std::vector<IdLayer> emptyIds(const FilmLayout& layout, size_t pixels);

// A whole film: equal samples leave equal words, however they were taken.
struct RawFilm {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> words; // layout.words() word planes in their order, of all pixels each
    RawTallies tallies{};
    FilmLayout layout = colorLayout();
    std::vector<IdLayer> ids{}; // one for each of layout.idLayers()

    [[nodiscard]] size_t pixels() const { return size_t{width} * height; }
    // Samples over all pixels.
    [[nodiscard]] uint64_t samples() const;
};

// Text of the mean over `pixels` of `samples`, for headers.
[[nodiscard]] std::string samplesPerPixel(uint64_t samples, uint64_t pixels);

// How far the samples of a film have come. Passes take some samples of all pixels, row by row.
struct FilmProgress {
    uint32_t samples = 0;     // samples of every pixel by the passes before
    uint32_t passSamples = 0; // samples a pixel in the pass under way; 0: none is
    uint32_t passPixels = 0;  // pixels that have the pass's samples
    bool operator==(const FilmProgress&) const = default;
};

// Adds the samples of a film of the same size and layout: the words are those of one film of all of them.
void add(RawFilm& sum, const RawFilm& more);

// A layer for each plane, named as it.
[[nodiscard]] Rendering resolve(const RawFilm& film);

// A rendering with a layer for each plane of the `rows` of FILM_PLANES (bit i for row i), all 0.
[[nodiscard]] Rendering emptyRendering(const FilmLayout& layout, uint32_t width, uint32_t height,
                                       uint32_t rows = 0xffffffffu);
// Writes the pixels of `words`, which are those from `firstPixel` on, into such a rendering of the whole
// image.
void resolvePixels(std::span<const uint32_t> words, const FilmLayout& layout, size_t firstPixel,
                   Rendering& rendering);

// Value of a fixed-point number: `words` lowest first, the lowest bit worth 2^lowestExponent.
[[nodiscard]] double fromFixed(std::span<const uint32_t> words, int lowestExponent);
// Value of such a number in two's complement.
[[nodiscard]] double fromSigned(std::span<const uint32_t> words, int lowestExponent);

struct PixelEstimate {
    double mean = 0.0;
    double varianceOfMean = 0.0;
};

// From the sums of `count` samples and of their squares. Fewer than two samples have no variance: 0.
[[nodiscard]] PixelEstimate estimate(double sum, double sumOfSquares, uint32_t count);

} // namespace lavalight
