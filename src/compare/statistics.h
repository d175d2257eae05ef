// How far images are from each other. Sums are taken in double precision.
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

// Boxes of factor x factor pixels averaged to one; boxes at the right and lower edges may be smaller. For a
// box of n pixels and each layer: mean = sum / n, variance of the mean = sum(variance) / n^2, samples = sum,
// at most 2^32 - 1.
[[nodiscard]] Rendering downsample(const Rendering& rendering, uint32_t factor);

} // namespace lavalight
