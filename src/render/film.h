// The exact film: integer sums of L and L^2 per pixel, in bands of rows, on the device.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "image/image.h"
#include "shared/film.h"

namespace lavalight {

// Rows [firstRow, firstRow + rows) of the image with their sums, laid out as in shaders/shared/film.h.
struct FilmBand {
    uint32_t firstRow = 0;
    uint32_t rows = 0;
    gpu::Buffer sums;
};

// Events that the ledger reports, counted by the kernels.
struct FilmTallies {
    uint64_t droppedSamples = 0; // NaN or infinity
    uint64_t saturatedSums = 0;
    uint64_t cutPaths = 0;      // ended by --max-bounces while they carried light
    double cutThroughput = 0.0; // mean over the cut paths
    uint64_t overlaps = 0;      // paths within two solids at once
    std::array<uint32_t, 2>
        overlapping{}; // meshes of two such solids, counted from 1; 65535: there or beyond
};

class Film {
  public:
    // bandRows 0: as many as one storage buffer of the device holds. Throws Error where memory does not
    // suffice.
    Film(gpu::Device& device, uint32_t width, uint32_t height, uint32_t bandRows);

    [[nodiscard]] uint32_t width() const { return width_; }
    [[nodiscard]] uint32_t height() const { return height_; }
    [[nodiscard]] std::span<const FilmBand> bands() const { return bands_; }
    [[nodiscard]] const gpu::Buffer& tallies() const { return tallies_; }

    // Zero samples everywhere.
    void clear();
    [[nodiscard]] Rendering resolve() const;
    [[nodiscard]] FilmTallies readTallies() const;

  private:
    gpu::Device* device_;
    uint32_t width_;
    uint32_t height_;
    std::vector<FilmBand> bands_;
    gpu::Buffer tallies_;
};

// Value of a fixed-point number: `words` lowest first, the lowest bit worth 2^lowestExponent.
[[nodiscard]] double fromFixed(std::span<const uint32_t> words, int lowestExponent);

struct PixelEstimate {
    double mean = 0.0;
    double varianceOfMean = 0.0;
};

// From the sums of `count` samples and of their squares. Fewer than two samples have no variance: 0.
[[nodiscard]] PixelEstimate estimate(double sum, double sumOfSquares, uint32_t count);

} // namespace lavalight
