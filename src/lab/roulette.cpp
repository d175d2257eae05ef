// Russian roulette: the lecture's eight rays, then every kind in the Cornell box.
#include <array>
#include <string>

#include "lab/experiment.h"
#include "lab/render_run.h"
#include "lab/sample_kernel.h"
#include "lab/theory.h"

namespace lavalight {
namespace {

constexpr uint32_t kRays = 8;
constexpr double kWatts = 16.0;
constexpr uint64_t kRouletteSamples = 1u << 18;
constexpr uint32_t kRouletteImageHeight = 48;

EstimatorRow rowOf(const std::string& name, uint32_t kind, double survival, const SampleKernel& kernel,
                   uint32_t seed) {
    LabRun run{};
    run.seed = seed;
    run.kind = kind;
    run.count = kRays;
    run.a.x = static_cast<float>(kWatts);
    run.a.y = static_cast<float>(survival);
    const Moments m = kernel.estimate(run, kRouletteSamples);
    const Theory theory = rouletteRays(kRays, kWatts, survival);
    EstimatorRow row = estimatorRow(name, m, theory);
    if (kind == kRouletteForgot)
        row.theory = theory.variance * survival * survival;
    row.more = {kRays * survival};
    return row;
}

Table rays(const LabDevice& lab, uint32_t seed) {
    const SampleKernel kernel(lab, "lab/roulette");
    Table table =
        estimatorTable("rays", "Power of 8 rays of 16 W",
                       {rowOf("all go on", kRouletteMadeUp, 1.0, kernel, seed),
                        rowOf("half of them, times 2", kRouletteMadeUp, 0.5, kernel, seed),
                        rowOf("half of them, as they are (wrong)", kRouletteForgot, 0.5, kernel, seed)},
                       {{"raysLeft", "rays left"}});
    table.notes = {
        "Each ray survives with p = 0.5 and then carries 16 W / p: 128 W in expectation, for half the work.",
        "Roulette adds variance, 8 * 16^2 * (1 / p - 1), and is worth it where the work saved is worth more.",
        "Without the 1 / p half of the light is lost, however many samples are taken."};
    return table;
}

Table box(const LabDevice& lab, const LabOptions& options) {
    struct Kind {
        const char* name;
        Roulette roulette;
    };
    constexpr std::array<Kind, 7> kinds{{{"off (64 bounces)", Roulette::off},
                                         {"constant 50 %", Roulette::constant},
                                         {"mean-albedo", Roulette::meanAlbedo},
                                         {"max-albedo", Roulette::maxAlbedo},
                                         {"throughput", Roulette::throughput},
                                         {"sqrt-throughput", Roulette::sqrtThroughput},
                                         {"cbrt-throughput", Roulette::cbrtThroughput}}};
    RenderBench bench(lab, "cornell-box", kRouletteImageHeight);
    RenderTable rows(bench, static_cast<uint32_t>(options.samples));
    EstimatorSettings estimator = independentSettings(options.seed);
    estimator.rouletteStart = 1; // from the first vertex on, as in the lecture
    for (const Kind& kind : kinds) {
        estimator.roulette = kind.roulette;
        rows.add(kind.name, estimator);
    }
    Table table = rows.table("cornell-box", "The Cornell box with roulette from the first vertex on");
    table.notes.emplace_back(
        "One mean, five prices: the shorter the paths, the larger the variance of a sample and the more "
        "samples in a second. Efficiency tells who wins.");
    return table;
}

} // namespace

std::vector<Table> runRoulette(const LabDevice& lab, const LabOptions& options) {
    return {rays(lab, options.seed), box(lab, options)};
}

} // namespace lavalight
