// How radiance becomes what a display shows.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "shared/tone.h"

namespace lavalight {

// The curves of shaders/lib/tone_map.glsl.
enum class ToneCurve : uint32_t {
    linear = kToneLinear,   // clamped, so that every code can be read back as radiance
    neutral = kToneNeutral, // Khronos PBR Neutral: base colours as they are, highlights compressed
    agx = kToneAgx,
    aces = kToneAces
};

struct ToneSettings {
    ToneCurve curve = ToneCurve::neutral;
    float exposure = 0.0f; // stops: radiance is multiplied by 2^exposure before the curve
    // Linear display values behind what a film's plane of coverage leaves open; none: pixels keep their
    // alpha.
    std::optional<glm::vec3> backdrop{};
    bool operator==(const ToneSettings&) const = default;
};

} // namespace lavalight
