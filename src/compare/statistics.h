// How far images are from each other, and whether noise explains it. Sums are taken in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "image/image.h"
#include "image/rendering.h"

namespace lavalight {

// All functions of two images throw Error if these differ in size or are empty. x is the image, r the
// reference.

// sqrt(mean((x - r)^2)) over pixels and channels; in units of radiance.
[[nodiscard]] double rmse(const Image& image, const Image& reference);

// mean((x - r)^2 / (r^2 + 0.01)) over pixels and channels. The 0.01 keeps pixels darker than 0.1 from
// dominating.
[[nodiscard]] double relMse(const Image& image, const Image& reference);

// relMse without the floor(0.1 %) of all pixels that contribute most to it (a pixel's contribution is the
// mean of its three channels), so that a few fireflies do not hide how the rest converges. Below 1000 pixels
// equal to relMse.
[[nodiscard]] double trimmedRelMse(const Image& image, const Image& reference);

// The index of the pixel that contributes most to relMse, the first of several; NaN is more than all.
[[nodiscard]] size_t worstOfRelMse(const Image& image, const Image& reference);

struct MeanDifference {
    glm::dvec3 perChannel{0.0}; // mean(x) / mean(r) - 1 of each channel
    double overall = 0.0;       // mean(x) / mean(r) - 1 of all channels together
};

// Relative difference of the image means: 0.01 is an image one per cent too bright. Where r is black: 0 if x
// is black too, infinite otherwise.
[[nodiscard]] MeanDifference relativeMeanDifference(const Image& image, const Image& reference);

// How many pixels hold a NaN or an infinity.
[[nodiscard]] uint64_t countNonFinite(const Image& image);

struct ZTest {
    uint32_t tileCount = 0;
    std::vector<float> absZ; // |z| of tiles row by row, three channels each
    float maxAbsZ = 0.0f;    // infinite where means differ though both variances are zero
    glm::uvec2 worstTile{0}; // the first pixel (x, y) of the tile with maxAbsZ
    int worstChannel = 0;    // 0, 1, 2 for R, G, B

    // The fraction of the tests, three to a tile, with |z| below `limit`. For independent samples and equal
    // means z is standard normal: 0.99903 of them are below 3.3.
    [[nodiscard]] double fractionBelow(float limit) const;
};

// Whether a and b may have the same mean, tile by tile. For a tile of n pixels and one channel
//   z = sum(a - b) / sqrt(sum(varianceA + varianceB)),
// which is the difference of the tile's means over its standard deviation, for pixels that are independent.
// Variances are of the mean, as Rendering holds them. Where both variances are zero, z is 0 for equal sums
// and infinite for others; NaN counts as infinite. Tiles at the right and lower edges may be smaller.
// tileSize 1 tests each pixel. Throws Error if the four sizes differ.
[[nodiscard]] ZTest tileZTest(const Image& a, const Image& varianceA, const Image& b, const Image& varianceB,
                              uint32_t tileSize);

// Boxes of factor x factor pixels averaged to one; boxes at the right and lower edges may be smaller. For a
// box of n pixels and each layer: mean = sum / n, variance of the mean = sum(variance) / n^2, samples = sum,
// at most 2^32 - 1.
[[nodiscard]] Rendering downsample(const Rendering& rendering, uint32_t factor);

} // namespace lavalight
