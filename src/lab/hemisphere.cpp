// Irradiance under two skies: directions all alike against directions by the cosine.
#include <string>

#include "lab/experiment.h"
#include "lab/sample_kernel.h"
#include "lab/theory.h"

namespace lavalight {
namespace {

EstimatorRow rowOf(Hemisphere directions, uint32_t sky, const SampleKernel& kernel,
                   const LabOptions& options) {
    LabRun run{};
    run.seed = options.seed;
    run.kind = static_cast<uint32_t>(directions);
    run.variant = sky;
    const Moments m = kernel.estimate(run, options.samples);
    const Theory theory = skyIrradiance(directions, sky == kSkyOvercast);
    const char* const name =
        directions == Hemisphere::uniform ? "uniform, pdf 1 / (2 pi)" : "cosine, pdf cos / pi";
    return estimatorRow(name, m, theory);
}

Table tableOf(const std::string& name, const std::string& title, uint32_t sky, const SampleKernel& kernel,
              const LabOptions& options) {
    return estimatorTable(
        name, title,
        {rowOf(Hemisphere::uniform, sky, kernel, options), rowOf(Hemisphere::cosine, sky, kernel, options)});
}

} // namespace

std::vector<Table> runHemisphere(const LabDevice& lab, const LabOptions& options) {
    const SampleKernel kernel(lab, "lab/hemisphere");
    Table constant = tableOf("constant", "Irradiance under a sky of radiance 1 (exact: pi)", kSkyConstant,
                             kernel, options);
    constant.notes = {"The cosine cancels against the pdf: every sample is pi."};
    Table overcast =
        tableOf("overcast", "Irradiance under the CIE overcast sky of zenith radiance 1 (exact: 7/9 pi)",
                kSkyOvercast, kernel, options);
    overcast.notes = {
        "Under clouds, three times as bright above as at the horizon, the sky's own gradient is the variance "
        "that is left."};
    return {constant, overcast};
}

} // namespace lavalight
