// Where samples of a pixel lie, by importance sampling of the pixel filter.
// Source: Ernst, Stamminger, Greiner, "Filter Importance Sampling", 2006.
#include "shared/frame.h"

float filterNode(FrameParameters parameters, uint i) {
    return parameters.filterNodes[i >> 2u][i & 3u];
}

// Offset from the middle of the pixel along one axis, by a random number; filters are symmetric. The nodes lie where the
// share of the filter within them is 1 - (1 - w)^2, w being evenly spaced: so the fading ends of filters are fine enough.
float filterOffset(FrameParameters parameters, float u) {
    const float within = abs(2.0 * u - 1.0);
    const float w = (1.0 - sqrt(1.0 - within)) * float(kFilterIntervals);
    const uint i = min(uint(w), kFilterIntervals - 1u);
    const float offset = mix(filterNode(parameters, i), filterNode(parameters, i + 1u), w - float(i));
    return u < 0.5 ? -offset : offset;
}

// Position of a sample in pixels from the corner of its pixel; it may lie outside.
vec2 filteredPosition(FrameParameters parameters, vec2 u) {
    return 0.5 + vec2(filterOffset(parameters, u.x), filterOffset(parameters, u.y));
}

// Weight of that sample: negative where one axis, but not both, is in a negative lobe.
float filterWeight(FrameParameters parameters, vec2 u) {
    const bvec2 isNegative = greaterThan(abs(2.0 * u - 1.0), vec2(parameters.filterPositive));
    return isNegative.x != isNegative.y ? -parameters.filterScale : parameters.filterScale;
}
