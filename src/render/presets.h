// The steps of the lecture as named settings.
#pragma once

#include <span>
#include <string_view>

#include "render/settings.h"

namespace lavalight {

struct Preset {
    std::string_view name;
    std::string_view sets;    // what it sets, as options
    std::string_view meaning; // what the lecture says of it
    EstimatorSettings settings;
};

[[nodiscard]] std::span<const Preset> presets();

// Finds a preset by name. Throws UsageError naming the presets there are.
[[nodiscard]] const Preset& findPreset(std::string_view name);

} // namespace lavalight
