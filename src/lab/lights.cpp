// A large and a small light: which to sample how often.
#include <array>

#include <fmt/format.h>

#include "lab/experiment.h"
#include "lab/render_run.h"
#include "lab/sample_kernel.h"
#include "lab/theory.h"

namespace lavalight {
namespace {

// Two spheres over a floor: the small one has a quarter of the large one's power.
constexpr SphereLight kLarge{0.8, 1.0, 4.0, 4.0};
constexpr SphereLight kSmall{0.6, 0.1, 4.0, 100.0};

struct Pick {
    std::string name;
    double large; // probability of the large light
};

glm::vec4 kernelLight(const SphereLight& light, double probability) {
    return glm::dvec4(light.cosCenter, light.oneMinusCosRim(), light.radiance, probability);
}

EstimatorRow rowOf(const Pick& pick, const SampleKernel& kernel, const LabOptions& options) {
    LabRun run{};
    run.seed = options.seed;
    run.a = kernelLight(kLarge, pick.large);
    run.b = kernelLight(kSmall, 1.0 - pick.large);
    const Moments m = kernel.estimate(run, options.samples);
    const Theory theory = twoLights(kLarge, kSmall, pick.large);
    return estimatorRow(fmt::format("{}, p = {:.3f}", pick.name, pick.large), m, theory);
}

Table spheres(const LabDevice& lab, const LabOptions& options) {
    const SampleKernel kernel(lab, "lab/lights");
    const double byPower = kLarge.power() / (kLarge.power() + kSmall.power());
    const std::array<Pick, 4> picks{{{"uniform", 0.5},
                                     {"by power", byPower},
                                     {"best", bestLightProbability(kLarge, kSmall)},
                                     {"by power, swapped", 1.0 - byPower}}};
    std::vector<EstimatorRow> rows;
    rows.reserve(picks.size());
    for (const Pick& pick : picks)
        rows.push_back(rowOf(pick, kernel, options));
    Table table = estimatorTable(
        "spheres", "Irradiance of a floor from a large dim and a small bright sphere, p for the large one",
        rows);
    table.notes = {"The light is picked with probability p, its direction uniformly in its cone, and the "
                   "sample divided by "
                   "both densities.",
                   "By power is nearly best where the lights are about as far away; best knows what each "
                   "brings to this very "
                   "point."};
    return table;
}

Table scene(const LabDevice& lab, uint32_t seed) {
    RenderBench bench(lab, "large-small-light", 48);
    RenderTable rows(bench, 128);
    EstimatorSettings estimator = independentSettings(seed);
    estimator.mis = Mis::off;
    estimator.maxBounces = 1;
    const std::array<std::pair<std::string, LightSelection>, 3> selections{
        {{"uniform", LightSelection::uniform},
         {"by power", LightSelection::power},
         {"tree", LightSelection::tree}}};
    for (const auto& [name, selection] : selections) {
        estimator.lightSelection = selection;
        rows.add(name, estimator);
    }
    Table table =
        rows.table("scene", "The scene large-small-light by light sampling alone, direct light only");
    table.notes.emplace_back("Power does not know distances: below the small light it is sampled too rarely, "
                             "everywhere else the large one "
                             "brings more and is picked more often. The tree does know them.");
    return table;
}

} // namespace

std::vector<Table> runLights(const LabDevice& lab, const LabOptions& options) {
    return {spheres(lab, options), scene(lab, options.seed)};
}

} // namespace lavalight
