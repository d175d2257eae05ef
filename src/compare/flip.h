// FLIP: the difference that people see when they flip between two images in place.
// Based on: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", 2020, for images of limited range, and Andersson, Nilsson, Shirley and
// Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images", 2021, for radiance.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace lavalight {

struct FlipMap {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float>
        errors; // row by row from the top, in [0, 1]: 0 nothing to see, 1 the largest difference

    [[nodiscard]] double mean() const;
    [[nodiscard]] size_t worst() const; // the index of the largest error, the first of several
};

// Both functions take the viewing conditions that the publications assume: a screen of 3840 pixels on 0.7 m
// at a distance of 0.7 m, 67 pixels to a degree. Negative values and NaN are black. Both throw Error if the
// images differ in size or are empty.

// FLIP of linear display values in [0, 1]; others are clamped.
[[nodiscard]] FlipMap flip(const Image& image, const Image& reference);

// What an exposure of radiance may be, in stops; the display shows 2^stops times the radiance.
struct ExposureRange {
    float start = 0.0f;
    float stop = 0.0f;
    uint32_t count = 2; // exposures, evenly from start to stop
};

// The range from the exposure that takes the brightest luminance of the reference to nearly white to the one
// that takes the median luminance there (2021, section 4).
[[nodiscard]] ExposureRange exposureRange(const Image& reference);

// FLIP of radiance: the largest flip() that any exposure of that range shows after ACES tone mapping, pixel
// by pixel.
[[nodiscard]] FlipMap flipOfRadiance(const Image& image, const Image& reference);

} // namespace lavalight
