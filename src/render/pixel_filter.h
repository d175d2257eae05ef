// Pixel filters, as tables that samples are drawn by.
#pragma once

#include <array>
#include <cstddef>

#include "render/estimator_settings.h"
#include "shared/frame.h"

namespace lavalight {

// One axis of a filter, which is the product of two axes. shaders/lib/sampling/pixel_filter.glsl draws by it.
struct FilterTable {
    std::array<float, kFilterIntervals + 1> nodes{}; // pixels from the middle, ascending
    float positive = 1.0f; // share of the filter's absolute value before its negative lobe
    float scale = 1.0f;    // weight of a sample, without its sign: of both axes
};

// Pixels from the middle to where the filter ends.
[[nodiscard]] float filterRadius(const EstimatorSettings& settings);
// Whether the filter is the box of one pixel, which takes no table.
[[nodiscard]] bool isUnitBox(const EstimatorSettings& settings);
[[nodiscard]] bool hasNegativeWeights(const EstimatorSettings& settings);

// The filter's value at a distance from the middle along one axis, in radii; 0 from 1 on. The scale is any.
[[nodiscard]] double filterValue(PixelFilter filter, double x);

[[nodiscard]] FilterTable filterTable(const EstimatorSettings& settings);

} // namespace lavalight
