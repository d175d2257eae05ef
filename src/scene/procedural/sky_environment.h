// A clear sky with its sun.
#pragma once

#include "scene/scene.h"

namespace lavalight {

struct SkySettings {
    float sunElevation = 45.0f; // degrees above the horizon, 0 to 90
    float sunAzimuth = -35.0f;  // degrees from +Z towards +X
    float turbidity = 3.0f;     // 1 (clear air) to 10 (haze)
    bool operator==(const SkySettings&) const = default;
};

// The sky of Hosek and Wilkie, "An Analytic Model for Full Spectral Sky-Dome Radiance", 2012, in linear Rec.
// 709, over a grey ground that it and the sun light. The sun is a disc of 0.533 degrees, dimmed by air and
// haze as in Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", 1999 (appendix 1; without
// ozone, gases and vapour). Radiance counts in units of which a surface that faces the sun of the defaults
// receives about 3.7, as in the studio: 1 unit is 27,000 cd/m^2. Throws UsageError for settings out of range.
[[nodiscard]] EnvironmentMap makeSky(const SkySettings& settings);

} // namespace lavalight
