// The curves of lib/film/tone_map.glsl in double precision, from the publications' own statements of them.
#pragma once

#include <glm/glm.hpp>

#include "render/tone_settings.h"

namespace lavalight::test {

// Linear display values in [0, 1] of linear Rec. 709, at least 0.
[[nodiscard]] glm::dvec3 toneReference(ToneCurve curve, const glm::dvec3& color);

// sRGB signals of linear values in [0, 1], and back.
[[nodiscard]] double srgbSignal(double linear);
[[nodiscard]] double linearOfSrgb(double signal);
[[nodiscard]] glm::dvec3 srgbSignal(const glm::dvec3& linear);

} // namespace lavalight::test
