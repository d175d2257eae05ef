// Multiple importance sampling on Veach's plates, and whether its weights should know of roulette.
#include "lab/experiment.h"
#include "lab/render_run.h"

namespace lavalight {
namespace {

constexpr uint32_t kMisImageHeight = 48;

} // namespace

std::vector<Table> runMis(const LabDevice& lab, const LabOptions& options) {
    RenderBench bench(lab, "veach-mis", kMisImageHeight);
    RenderTable rows(bench, static_cast<uint32_t>(options.samples));
    EstimatorSettings estimator = independentSettings(options.seed);
    estimator.nextEventEstimation = false;
    rows.add("BSDF only", estimator);
    estimator.nextEventEstimation = true;
    estimator.mis = Mis::off;
    rows.add("light only", estimator);
    estimator.mis = Mis::balance;
    rows.add("balance heuristic", estimator);
    estimator.mis = Mis::power;
    rows.add("power heuristic", estimator);
    Table table = rows.table("veach-mis", "Veach's plates: BSDF sampling, light sampling, both weighted");
    table.notes.emplace_back(
        "BSDF sampling seldom hits the small lamps, light sampling seldom hits the narrow lobes of the "
        "smooth plates; weighted, each does what it does well.");
    table.notes.emplace_back(
        "The rarer the hits, the more of the variance sits in samples that such a short render may miss: "
        "figures of the first two rows are rather too small than too large.");
    return {table};
}

std::vector<Table> runSurvival(const LabDevice& lab, const LabOptions& options) {
    std::vector<Table> tables;
    for (const char* scene : {"cornell-box", "veach-mis"}) {
        RenderBench bench(lab, scene, kMisImageHeight);
        RenderTable rows(bench, static_cast<uint32_t>(options.samples));
        EstimatorSettings estimator = independentSettings(options.seed);
        estimator.rouletteStart = 1;
        estimator.roulette = Roulette::meanAlbedo;
        rows.add("weights by pdf", estimator);
        estimator.misSurvival = true;
        rows.add("by pdf * survival", estimator);
        tables.push_back(rows.table(
            scene, std::string(scene) + " with mean-albedo roulette: weights with and without survival"));
    }
    tables.front().notes.emplace_back("A BSDF sample that may die finds a light with density pdf * survival. "
                                      "Either density may be used, as long as both "
                                      "weights use the same: they sum to 1, and so both are unbiased. With "
                                      "survival the weights trust BSDF samples less, "
                                      "as they should.");
    return tables;
}

} // namespace lavalight
