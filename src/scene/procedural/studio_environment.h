// The light of models that bring none: a photographer's studio.
#pragma once

#include "image/image.h"

namespace lavalight {

// An equirectangular map (EnvironmentMap): walls of a grey gradient, a large soft box above the left shoulder
// of a camera that looks along -Z, a dim one at its right, one overhead, and two narrow ones behind, which
// draw the edges of what shines. Grey throughout. A surface that faces the light has an irradiance of 3.7, so
// that a Lambert surface of albedo 0.18 shows an sRGB signal of 0.45 to 0.5, through the neutral tone curve
// and without one.
[[nodiscard]] Image makeStudio();

} // namespace lavalight
