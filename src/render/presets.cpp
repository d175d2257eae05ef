#include "render/presets.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "render/setting_text.h"

namespace lavalight {
namespace {

// Each step changes one thing of the step before it.
constexpr EstimatorSettings naive() {
    EstimatorSettings s;
    s.sampler = Sampler::independent;
    s.hemisphere = Hemisphere::uniform;
    s.nextEventEstimation = false;
    s.lightSelection = LightSelection::power; // once there is NEE
    s.roulette = Roulette::off;
    return s;
}

constexpr EstimatorSettings cosine() {
    EstimatorSettings s = naive();
    s.hemisphere = Hemisphere::cosine;
    return s;
}

constexpr EstimatorSettings nee() {
    EstimatorSettings s = cosine();
    s.nextEventEstimation = true;
    s.mis = Mis::off;
    return s;
}

constexpr EstimatorSettings mis() {
    EstimatorSettings s = nee();
    s.mis = Mis::power;
    return s;
}

constexpr EstimatorSettings roulette() {
    EstimatorSettings s = mis();
    s.roulette = Roulette::throughput;
    return s;
}

constexpr std::array<Preset, 6> kPresets{{
    {"naive", "", "Kajiya's estimator as it stands: random directions until light is hit", naive()},
    {"cosine", "naive", "importance sampling of the cosine: grazing directions count less", cosine()},
    {"nee", "cosine", "next-event estimation: light is sampled directly, and only so", nee()},
    {"mis", "nee", "light and BSDF samples combined by Veach's power heuristic", mis()},
    {"roulette", "mis", "paths that carry little are ended at random, without bias", roulette()},
    {"reference", "roulette", "the best this program knows", EstimatorSettings{}},
}};

} // namespace

std::span<const Preset> presets() {
    return kPresets;
}

const Preset& findPreset(std::string_view name) {
    const auto found =
        std::find_if(kPresets.begin(), kPresets.end(), [&](const Preset& p) { return p.name == name; });
    if (found != kPresets.end())
        return *found;
    std::string known;
    for (const Preset& preset : kPresets)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", preset.name);
    throw UsageError(fmt::format("--preset: \"{}\" is not one of {}", name, known));
}

std::string optionsOf(const Preset& preset) {
    const EstimatorSettings defaults;
    if (preset.before.empty())
        return optionsFrom(defaults, preset.settings);
    return fmt::format("{}as {}, with {}", preset.settings == defaults ? "all defaults: " : "", preset.before,
                       optionsFrom(findPreset(preset.before).settings, preset.settings));
}

} // namespace lavalight
