// The filters of FLIP, separable, over planes of floats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lavalight {

// Values row by row.
struct Plane {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> values;

    Plane(uint32_t w, uint32_t h) : width(w), height(h), values(size_t{w} * h) {}
    [[nodiscard]] float* row(uint32_t y) { return values.data() + size_t{y} * width; }
    [[nodiscard]] const float* row(uint32_t y) const { return values.data() + size_t{y} * width; }
};

// Weights of the pixels at -radius to +radius.
struct Filter {
    std::vector<float> weights;

    [[nodiscard]] int radius() const { return static_cast<int>(weights.size() / 2); }
};

// The contrast sensitivity of an eye as a blur (2020, section 4.1.1 and table 1): of each channel of YCxCz
// one Gaussian, of Cz the sum of two. Each Gaussian's weights add up to its share.
struct ContrastFilters {
    Filter luminance;
    Filter redGreen;
    Filter blueYellowNarrow; // the first of two Gaussians, whose 2-D shares are normalised together
    Filter blueYellowWide;
    float narrowShare = 0.0f;
    float wideShare = 0.0f;
};
[[nodiscard]] ContrastFilters contrastFilters(float pixelsPerDegree);

// Detectors of edges and points (2020, section 4.2): a Gaussian and its first and second derivative, each
// derivative with positive weights that add up to 1 and negative ones that add up to -1.
struct FeatureFilters {
    Filter smooth;
    Filter edge;
    Filter point;
};
[[nodiscard]] FeatureFilters featureFilters(float pixelsPerDegree);

// How many pixels around a pixel its FLIP depends on.
[[nodiscard]] uint32_t flipReach(const ContrastFilters& contrast, const FeatureFilters& features);

// The plane, filtered along its rows or its columns; beyond its edges it goes on with its outermost pixels.
[[nodiscard]] Plane filterRows(const Plane& plane, const Filter& filter);
[[nodiscard]] Plane filterColumns(const Plane& plane, const Filter& filter);

} // namespace lavalight
