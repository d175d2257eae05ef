// Whether noise explains the difference of two renders.
// Based on: B. L. Welch, "The Generalization of 'Student's' Problem when Several Different Population
// Variances are Involved", 1947.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "image/image.h"

namespace lavalight {

// An image that may be noisy. Without variances it counts as exact; without sample counts its variances do.
struct Estimate {
    const Image* mean = nullptr;
    const Image* variance = nullptr;          // variance of the mean; may be absent
    std::span<const uint32_t> sampleCounts{}; // samples of each pixel; may be absent
};

// The difference image - reference over a tile, channel by channel, as sums over the pixels that can be
// tested.
struct TileDifference {
    glm::uvec2 first{0}; // the tile's first pixel (x, y)
    glm::dvec3 difference{0.0};
    glm::dvec3 reference{0.0}; // the reference's value
    glm::dvec3 imageVariance{0.0};
    glm::dvec3 referenceVariance{0.0};
    glm::dvec3 variance{0.0}; // the difference's: the sum of both or, where samples differ in number, more
    glm::dvec3 spread{0.0}; // sum(v^2 / degrees of freedom) of the estimates v that `variance` is the sum of
};

// The tiles row by row; those at the right and lower edges may be smaller. Throws Error if the images differ
// in size or are empty.
[[nodiscard]] std::vector<TileDifference> tileDifferences(const Estimate& image, const Estimate& reference,
                                                          uint32_t tileSize);

// |z| of a difference with the given standard deviation: 0 for none, infinite for NaN and where a difference
// has no deviation.
[[nodiscard]] double absoluteZ(double difference, double deviation);

// Whether the images have a pixel that can be tested. They have one size.
[[nodiscard]] bool hasTestablePixel(const Estimate& image, const Estimate& reference);

struct WelchTest {
    std::vector<float> absZ; // |z| of tiles row by row, three channels each; 0 where nothing could be tested
    float maxAbsZ = 0.0f;    // infinite where means differ though both variances are zero
    double p = 1.0;          // the smallest p-value times the number of tests (Bonferroni), at most 1
    glm::uvec2 worstTile{0}; // the first pixel (x, y) of the tile with that p
    int worstChannel = 0;    // 0, 1, 2 for R, G, B
    float worstAbsZ = 0.0f;  // |z| of that test

    // The fraction of the tests with |z| below `limit`.
    [[nodiscard]] double fractionBelow(float limit) const;
};

// Tests tile by tile and channel by channel whether both may have the same mean. z is the difference of the
// sums over a tile's pixels, over its standard deviation. As variances are estimated too, from few samples
// where rare bright paths make them, z has the tails of Student's t; its degrees of freedom follow from the
// variances and sample counts of the tile's pixels (Welch 1947). Where sample counts differ, each pixel's
// variance is at least what the samples of both images together say of one. Differences below 1e-4 of the
// reference's tile, as other drivers may round them, are none to p, though |z| is as it is. Pixels that have
// variances and fewer than two samples are left out. Throws Error as tileDifferences does.
[[nodiscard]] WelchTest welchTest(const Estimate& image, const Estimate& reference, uint32_t tileSize);

} // namespace lavalight
