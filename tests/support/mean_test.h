// Whether two estimators have the same mean, and how small a bias the answer could have missed.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "image/image.h"

namespace lavalight::test {

// A comparison of two images of independent samples, channel by channel: tile by tile, tiles of kTileSides
// pixels, and all tiles of a size together, which is to say the mean of their relative differences.
struct MeanComparison {
    uint32_t tests = 0;         // tests that are precise enough to count
    double share = 0.0;         // share of tiles that count, of the size where it is largest
    double limit = 0.0;         // limit of |z|: what kFalseAlarm leaves to each test, after Bonferroni
    double worstZ = 0.0;        // largest |z|
    std::string worst;          // where that is
    double visibleBias = 0.0;   // smallest relative bias that would have shown if all tiles had it
    double visibleInTile = 0.0; // if one tile had it, the median of those that count

    [[nodiscard]] bool same() const { return worstZ <= limit; }
    // One line with all of it, percentages for people.
    [[nodiscard]] std::string text() const;
};

constexpr std::array<uint32_t, 3> kTileSides{4, 8, 16}; // pixels

// Probability that a comparison of images with equal means says that they differ.
constexpr double kFalseAlarm = 1e-4;
// A tile counts only where the standard error of each image is below this share of its mean: noisier ones
// hide a bias, and sums of few rare samples are not normal yet.
constexpr double kPrecision = 0.02;

[[nodiscard]] MeanComparison compareMeans(const Rendering& image, const Rendering& reference);

// The z that a normal variable exceeds, to either side, with that probability. Found by bisection.
[[nodiscard]] double twoSidedQuantile(double probability);

} // namespace lavalight::test
