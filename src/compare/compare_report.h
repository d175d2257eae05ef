// The page of a comparison.
#pragma once

#include <string>

#include "compare/comparison.h"

namespace lavalight {

// FLIP of each pixel as a PNG file, in the colours of heatColour().
[[nodiscard]] std::string heatmapPng(const FlipMap& flip);

// One HTML file that needs no other and no network: both images with a slider between them, at several
// exposures if they hold radiance, the heat map, all figures and verdicts.
[[nodiscard]] std::string reportHtml(const Comparison& comparison, const ComparedImage& image,
                                     const ComparedImage& reference);

} // namespace lavalight
