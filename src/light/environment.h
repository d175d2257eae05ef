// How light from an equirectangular map is sampled: by what bilinear lookups find in each direction.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "image/image.h"

namespace lavalight {

// Where a square of two by two cells, or of two by two such squares, and so on, sends a random point.
struct EnvironmentQuad {
    float top = 1.0f;          // probability of the upper half; rows count from the top
    float leftOfTop = 1.0f;    // probability, within the upper half, of its left quarter
    float leftOfBottom = 1.0f; // probability, within the lower half, of its left quarter
    float levels = 0.0f;       // number of levels of quads; in the first quad alone
};

// Cells lie between texel centres, where lookups are bilinear: cell (x, y) has texel (x, y) at its lower
// right corner and, wrapped around in x, texel (x - 1, y - 1) at its upper left. The first and the last of
// the height + 1 rows are half as high.
//
// A cell is picked by going down levels of quads, from the one over the whole map to those of cells, each row
// by row; level k above the cells has ceil(width / 2^k) x ceil((height + 1) / 2^k) quads. The point of the
// unit square is warped on the way, as by Clarberg, Jarosz, Akenine-Moeller, Jensen, "Wavelet Importance
// Sampling", 2005, which keeps strata together. Within the cell, the density per solid angle is its scale
// times the sum of the channels, interpolated between the corners bilinearly in u and in solid angle: 0 only
// where lookups are 0.
struct EnvironmentDistribution {
    uint32_t width = 0; // texels of the map in a row
    uint32_t height = 0;
    std::vector<EnvironmentQuad> quads;
    std::vector<float> scales;    // per cell: its probability by the quads, rounding and all, over its mass
    glm::dvec3 meanRadiance{0.0}; // mean over the sphere
};

// `map`: u grows to the right, from +Y at the top to -Y; values are finite and not negative. All scales are 0
// for a black map.
[[nodiscard]] EnvironmentDistribution makeEnvironmentDistribution(const Image& map);

} // namespace lavalight
