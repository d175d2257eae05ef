#include "lab/experiment.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "lab/sample_kernel.h"

namespace lavalight {
namespace {

constexpr uint64_t kSamples = uint64_t{1} << 20;
constexpr std::string_view kRenderUnit = "samples per pixel";
constexpr uint64_t kMostRenderSamples = 1u << 16;

constexpr std::array<Experiment, 9> kExperiments{{
    {"dice", "6 D1 + D2 by two dice or by one at a time: which die to roll how often?", "rolls", kSamples,
     1024, kMostLabSamples, runDice},
    {"strata", "an integral by 1, 8, 64 and infinitely many strata, picked at random", "samples", kSamples,
     1024, kMostLabSamples, runStrata},
    {"hemisphere", "irradiance under a constant and a cloudy sky: directions all alike or by the cosine?",
     "samples", kSamples, 1024, kMostLabSamples, runHemisphere},
    {"lights", "a large and a small light: which to sample how often?", "samples of two spheres", kSamples,
     1024, kMostLabSamples, runLights},
    {"roulette", "8 rays of 16 W, half of them killed; then every roulette in the Cornell box", kRenderUnit,
     128, 2, kMostRenderSamples, runRoulette},
    {"mis", "Veach's plates: BSDF sampling, light sampling, or both?", kRenderUnit, 128, 2,
     kMostRenderSamples, runMis},
    {"survival", "does the probability of survival belong into the weights of MIS?", kRenderUnit, 256, 2,
     kMostRenderSamples, runSurvival},
    {"fresnel", "glass by Fresnel's equations or by Schlick's approximation: how far apart?", kRenderUnit,
     128, 2, kMostRenderSamples, runFresnel},
    {"sampler", "independent numbers or Sobol's: how fast does the error fall?",
     "samples of the longest estimate", 4096, 16, 65536, runSampler},
}};

} // namespace

std::span<const Experiment> experiments() {
    return kExperiments;
}

const Experiment& findExperiment(std::string_view name) {
    const auto found = std::find_if(kExperiments.begin(), kExperiments.end(),
                                    [&](const Experiment& e) { return e.name == name; });
    if (found != kExperiments.end())
        return *found;
    std::string known;
    for (const Experiment& experiment : kExperiments)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", experiment.name);
    throw UsageError(fmt::format(
        "lab: \"{}\" is not an experiment; there are {} (and list, which describes them)", name, known));
}

std::vector<Table> runExperiment(const Experiment& experiment, const LabDevice& lab, LabOptions options) {
    if (options.samples == 0)
        options.samples = experiment.defaultSamples;
    if (options.samples < experiment.leastSamples || options.samples > experiment.mostSamples)
        throw UsageError(fmt::format("--samples: {} counts {}, {} to {} of them, not {}", experiment.name,
                                     experiment.sampleUnit, experiment.leastSamples, experiment.mostSamples,
                                     options.samples));
    return experiment.run(lab, options);
}

} // namespace lavalight
