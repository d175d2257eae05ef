// Colours for maps of numbers.
#pragma once

#include <cstdint>

namespace lavalight {

// The pixel of a share in [0, 1], as writePng() takes it: from black over purple and orange to pale yellow,
// in steps that look equal, also in grey. What lies outside is clamped; NaN is black.
[[nodiscard]] uint32_t heatColour(float share);

} // namespace lavalight
