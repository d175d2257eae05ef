#include "render/settings.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "render/setting_names.h"

namespace lavalight {
namespace {

void requireRange(const char* option, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw UsageError(fmt::format("{}: {} is outside the range {} to {}", option, value, least, most));
}

// Survival is known before the direction is drawn, as --mis-survival needs it.
bool isKnownBeforeSampling(Roulette roulette) {
    return roulette == Roulette::constant || roulette == Roulette::meanAlbedo ||
           roulette == Roulette::maxAlbedo;
}

void checkEstimator(const EstimatorSettings& e) {
    constexpr double most32 = 0x7fffffff;
    requireRange("--max-bounces", e.maxBounces, 0, kMaxBounceLimit);
    requireRange("--roulette-start", e.rouletteStart, 1, most32);
    if (!(e.rouletteProbability > 0.0f && e.rouletteProbability <= 1.0f))
        throw UsageError(
            fmt::format("--roulette-probability: {} is outside the range above 0 to 1: a path that never "
                        "survives cannot stand for the others",
                        e.rouletteProbability));
    if (!(e.clampIndirect > 0.0f))
        throw UsageError(fmt::format("--clamp-indirect: {} is not above 0", e.clampIndirect));
    if (e.misSurvival && !isKnownBeforeSampling(e.roulette))
        throw UsageError(
            fmt::format("--mis-survival on needs a --roulette of constant, mean-albedo or max-albedo, whose "
                        "probability does not depend on the direction drawn; it is {}",
                        nameOf(e.roulette)));
}

} // namespace

void checkSettings(const RenderSettings& settings) {
    requireRange("--size (width)", settings.image.width, 1, kMaxImageSide);
    requireRange("--size (height)", settings.image.height, 1, kMaxImageSide);
    requireRange("--spp", settings.stop.samples, 1, 0x7fffffff);
    if (settings.work.waveSize != 0)
        requireRange("--wave-size", settings.work.waveSize, 64, 4000000);
    requireRange("--time", settings.stop.seconds, 0, 1e9);
    requireRange("--target-error", settings.stop.targetError, 0, 1e9);
    if (!std::isfinite(settings.lighting.rotation))
        throw UsageError(
            fmt::format("--env-rotation: {} is no angle in degrees", settings.lighting.rotation));
    requireRange("--env-intensity", settings.lighting.intensity, 0, 1e30);
    checkEstimator(settings.estimator);
}

OptionPairs describe(const RenderSettings& settings) {
    const EstimatorSettings& e = settings.estimator;
    OptionPairs pairs;
    const auto add = [&](const char* option, auto value) {
        pairs.emplace_back(option, fmt::format("{}", value));
    };
    add("schedule", nameOf(settings.work.schedule));
    add("size", fmt::format("{}x{}", settings.image.width, settings.image.height));
    add("spp", settings.stop.samples);
    add("first-sample", settings.image.firstSample);
    add("time", settings.stop.seconds);
    add("target-error", settings.stop.targetError);
    add("sampler", nameOf(e.sampler));
    add("hemisphere", nameOf(e.hemisphere));
    add("nee", e.nextEventEstimation ? "on" : "off");
    add("light-selection", nameOf(e.lightSelection));
    add("mis", nameOf(e.mis));
    add("roulette", nameOf(e.roulette));
    add("roulette-start", e.rouletteStart);
    add("roulette-probability", e.rouletteProbability);
    add("mis-survival", e.misSurvival ? "on" : "off");
    add("fresnel", nameOf(e.fresnel));
    add("multiple-scattering", e.multipleScattering ? "on" : "off");
    add("texture-filter", nameOf(e.textureFilter));
    add("max-bounces", e.maxBounces);
    add("clamp-indirect", std::isinf(e.clampIndirect) ? "off" : fmt::format("{}", e.clampIndirect));
    add("seed", e.seed);
    if (settings.lighting.constant)
        add("env", fmt::format("{},{},{}", settings.lighting.constant->x, settings.lighting.constant->y,
                               settings.lighting.constant->z));
    if (!settings.lighting.mapFile.empty()) {
        add("env", settings.lighting.mapFile);
        add("env-rotation", settings.lighting.rotation);
    }
    add("env-intensity", settings.lighting.intensity);
    if (!settings.provenance.changedShaders.empty())
        add("shaders", fmt::format("{}", fmt::join(settings.provenance.changedShaders, ",")));
    pairs.insert(pairs.end(), settings.provenance.cameraOptions.begin(),
                 settings.provenance.cameraOptions.end());
    return pairs;
}

} // namespace lavalight
