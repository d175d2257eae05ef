// The steps of the lecture as named settings.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "render/estimator_settings.h"

namespace lavalight {

struct Preset {
    std::string_view name;
    std::string_view before;  // the preset that it goes one step on from; empty: the defaults
    std::string_view meaning; // what the lecture says of it
    EstimatorSettings settings;
};

[[nodiscard]] std::span<const Preset> presets();

// Finds a preset by name. Throws UsageError naming the presets there are.
[[nodiscard]] const Preset& findPreset(std::string_view name);

// What it sets, as options: "as nee, with --mis power".
[[nodiscard]] std::string optionsOf(const Preset& preset);

} // namespace lavalight
