// Which light the window's panel offers, and which it has.
#pragma once

#include <string>
#include <vector>

#include "render/settings.h"

namespace lavalight {

// A light by its word on the command line, and what `--env` makes of it.
struct LightOffer {
    std::string name;
    LightingSettings lighting; // rotation and intensity do not count
};

// The file's own light, studio, sky, white, and the light in use or the map used before, where it is none of
// these. `map`: the file that was used last; empty: none.
[[nodiscard]] std::vector<LightOffer> lightOffers(const LightingSettings& now, const std::string& map);

// Whether both ask for the same environment, turned and dimmed as they may be.
[[nodiscard]] bool isSameLight(const LightingSettings& a, const LightingSettings& b);

// Gives `settings` the environment of `light`, and leaves rotation and intensity.
void takeLight(const LightingSettings& light, LightingSettings& settings);

} // namespace lavalight
