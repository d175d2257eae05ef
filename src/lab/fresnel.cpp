// Glass by Fresnel's equations and by Schlick's approximation: two models, not two estimators of one.
#include "lab/experiment.h"
#include "lab/render_run.h"
#include "lab/sample_kernel.h"
#include "lab/theory.h"

namespace lavalight {
namespace {

constexpr double kGlass = 1.5;
constexpr uint64_t kFresnelSamples = 1u << 20;
constexpr uint32_t kFresnelImageHeight = 48;

EstimatorRow rowOf(const char* name, Fresnel fresnel, double eta, const SampleKernel& kernel, uint32_t seed) {
    LabRun run{};
    run.seed = seed;
    run.kind = static_cast<uint32_t>(fresnel);
    run.a.x = static_cast<float>(eta);
    const Moments m = kernel.estimate(run, kFresnelSamples);
    return {name, m.count, m.mean, diffuseReflectance(fresnel, eta), m.standardError(), m.variance(),
            {},   1.0,     {}};
}

Table reflectance(const LabDevice& lab, uint32_t seed) {
    const SampleKernel kernel(lab, "lab/fresnel");
    Table table =
        estimatorTable("reflectance", "Mean reflectance of glass (index 1.5) under diffuse light",
                       {rowOf("exact, from outside", Fresnel::exact, kGlass, kernel, seed),
                        rowOf("Schlick, from outside", Fresnel::schlick, kGlass, kernel, seed),
                        rowOf("exact, from inside", Fresnel::exact, 1.0 / kGlass, kernel, seed),
                        rowOf("Schlick, from inside", Fresnel::schlick, 1.0 / kGlass, kernel, seed)});
    table.notes = {"Schlick's curve is right at normal and at grazing incidence and too low between."};
    return table;
}

Table scene(const LabDevice& lab, const LabOptions& options) {
    RenderBench bench(lab, "cornell-glass", kFresnelImageHeight);
    RenderTable rows(bench, static_cast<uint32_t>(options.samples));
    EstimatorSettings estimator = independentSettings(options.seed);
    rows.add("exact", estimator);
    estimator.fresnel = Fresnel::schlick;
    rows.add("Schlick", estimator);
    Table table = rows.table("cornell-glass", "The Cornell box with a ball of glass");
    table.notes.emplace_back("The means differ because the models do, but by little: it takes many samples "
                             "to see it in a picture.");
    return table;
}

} // namespace

std::vector<Table> runFresnel(const LabDevice& lab, const LabOptions& options) {
    return {reflectance(lab, options.seed), scene(lab, options)};
}

} // namespace lavalight
