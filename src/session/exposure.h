// How bright a picture is: which exposure suits it, and whether it shows anything.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "image/rendering.h"

namespace lavalight {

// Stops that bring the log-average luminance of an image to middle grey, 0.18. Where the image has a layer of
// coverage, what is covered counts, by its coverage; else every pixel that is not black. 0 where there is
// nothing to expose. Based on: Reinhard, Stark, Shirley, Ferwerda, "Photographic Tone Reproduction for
// Digital Images", 2002 (section 3.1).
[[nodiscard]] float autoExposure(const Rendering& rendering);

// A message where more than half of what a picture shows of the scene is white or black; else nothing.
// `pixels`: sRGB (ToneMapper::map()); `coverage`: the layer, of which 0 does not count, or null; `advice`:
// what may help.
[[nodiscard]] std::string extremesText(std::span<const uint32_t> pixels, const Image* coverage,
                                       const std::string& advice);

} // namespace lavalight
