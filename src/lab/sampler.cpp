// Independent numbers against Sobol's: how the error falls with the number of samples.
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lab/experiment.h"
#include "lab/render_run.h"
#include "lab/sample_kernel.h"
#include "lab/theory.h"

namespace lavalight {
namespace {

constexpr uint32_t kSequences =
    256; // estimates that an error is taken over: it is known to 1 / sqrt(2 * 256) = 4 %
constexpr std::array<Sampler, 2> kSamplers{Sampler::independent, Sampler::sobol};

// Errors of estimates with more and more samples, for each of kSamplers.
struct Convergence {
    std::vector<double> samples;
    std::array<std::vector<double>, 2> means;  // means of all estimates
    std::array<std::vector<double>, 2> errors; // RMSE
};

struct Integrand {
    const char* name;
    const char* formula;
    uint32_t variant;
    double exact;
};

const std::array<Integrand, kIntegrandCount> kIntegrands{{
    {"bump", "36 x (1 - x) y (1 - y)", kIntegrandBump, 1.0},
    {"slope", "1 / (1 + x + y)", kIntegrandSlope, 3.0 * std::log(3.0) - 4.0 * std::log(2.0)},
    {"ridge", "1 / (1 + 25 (x - y)^2)", kIntegrandRidge, 0.4 * std::atan(5.0) - 0.04 * std::log(26.0)},
    {"disk", "1 inside a quarter of the unit disk, else 0", kIntegrandDisk, 0.25 * std::numbers::pi},
}};

Convergence integrate(const Integrand& integrand, const std::array<SampleKernel, 2>& kernels,
                      const LabOptions& options) {
    Convergence result;
    LabRun run{};
    run.seed = options.seed;
    run.variant = integrand.variant;
    for (uint32_t samples = 4; samples <= options.samples; samples *= 4) {
        result.samples.push_back(samples);
        for (size_t s = 0; s < kernels.size(); ++s) {
            double mean = 0.0;
            double squares = 0.0;
            for (const Moments& estimate : kernels[s].streams(run, kSequences, samples)) {
                const double error = estimate.mean - integrand.exact;
                mean += estimate.mean / kSequences;
                squares += error * error / kSequences;
            }
            result.means[s].push_back(mean);
            result.errors[s].push_back(std::sqrt(squares));
        }
    }
    return result;
}

// One row per number of samples, which grows by a factor; logarithms beside the errors, so that slopes can be
// read off.
Table convergenceTable(std::string name, std::string title, const Convergence& c,
                       std::optional<double> exact) {
    Table table{std::move(name), std::move(title), {}, {}, {}};
    table.columns = {{"samples", "samples"},      {"log2Samples", "log2"},
                     {"exact", "exact"},          {"independentEstimate", "independent"},
                     {"independentRmse", "RMSE"}, {"log2IndependentRmse", "log2"},
                     {"sobolEstimate", "Sobol"},  {"sobolRmse", "RMSE"},
                     {"log2SobolRmse", "log2"},   {"mseRatio", "MSE ratio"}};
    for (size_t i = 0; i < c.samples.size(); ++i) {
        const double ratio = c.errors[1][i] / c.errors[0][i];
        table.rows.push_back({static_cast<uint64_t>(c.samples[i]), std::log2(c.samples[i]), cellOf(exact),
                              c.means[0][i], c.errors[0][i], std::log2(c.errors[0][i]), c.means[1][i],
                              c.errors[1][i], std::log2(c.errors[1][i]), ratio * ratio});
    }
    return table;
}

// Slope of the line through the logarithms, for each sampler.
std::vector<Cell> slopes(const std::string& name, const Convergence& c) {
    return {name, logLogSlope(c.samples, c.errors[0]), logLogSlope(c.samples, c.errors[1])};
}

constexpr uint32_t kSamplerImageHeight = 32;
constexpr uint32_t kImageSeeds = 8;
constexpr uint32_t kImageStep = 16; // samples of a wave: a film is looked at after 16, 64 and 256
constexpr uint32_t kImageSamples = 256;

// Images of the first 16, 64, 256 samples of one render.
std::vector<Image> snapshots(RenderBench& bench, const EstimatorSettings& estimator) {
    RenderSettings settings = bench.settings(estimator, kImageSamples);
    settings.work.waveSize = settings.image.width * settings.image.height * kImageStep;
    std::vector<Image> images;
    uint32_t next = kImageStep;
    bench.finish(bench.render(settings, [&](double fraction, const Renderer& renderer) {
        if (std::lround(fraction * kImageSamples) >= next) {
            images.push_back(renderer.rendering().radiance());
            next *= 4;
        }
    }));
    return images;
}

// Mean over pixels and channels, of the mean and the variance over seeds: that variance is the mean squared
// error.
void addImages(Convergence& result, size_t sampler, const std::vector<std::vector<Image>>& bySeed,
               size_t level) {
    const size_t pixels = bySeed.front()[level].pixels.size();
    double mean = 0.0;
    double squares = 0.0;
    for (size_t pixel = 0; pixel < pixels; ++pixel)
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            std::vector<double> values;
            values.reserve(bySeed.size());
            for (const auto& images : bySeed)
                values.push_back(images[level].pixels[pixel][channel]);
            const Moments m = momentsOf(values);
            mean += m.mean;
            squares += m.variance();
        }
    const double count = 3.0 * static_cast<double>(pixels);
    result.means[sampler].push_back(mean / count);
    result.errors[sampler].push_back(std::sqrt(squares / count));
}

Convergence renderBox(const LabDevice& lab, uint32_t seed) {
    RenderBench bench(lab, "cornell-box", kSamplerImageHeight);
    Convergence result;
    for (uint32_t samples = kImageStep; samples <= kImageSamples; samples *= 4)
        result.samples.push_back(samples);
    for (size_t s = 0; s < kSamplers.size(); ++s) {
        std::vector<std::vector<Image>> bySeed;
        for (uint32_t i = 0; i < kImageSeeds; ++i) {
            EstimatorSettings estimator;
            estimator.sampler = kSamplers[s];
            estimator.seed = seed + i;
            bySeed.push_back(snapshots(bench, estimator));
        }
        for (size_t level = 0; level < result.samples.size(); ++level)
            addImages(result, s, bySeed, level);
    }
    return result;
}

} // namespace

std::vector<Table> runSampler(const LabDevice& lab, const LabOptions& options) {
    const std::array<SampleKernel, 2> kernels{SampleKernel(lab, "lab/sampler", kSamplers[0]),
                                              SampleKernel(lab, "lab/sampler", kSamplers[1])};
    std::vector<Table> tables;
    Table fits{"slopes",
               "Slope of log(RMSE) against log(samples)",
               {{"estimator", "integral"}, {"independentSlope", "independent"}, {"sobolSlope", "Sobol"}},
               {},
               {}};
    for (const Integrand& integrand : kIntegrands) {
        const Convergence c = integrate(integrand, kernels, options);
        tables.push_back(
            convergenceTable(integrand.name,
                             fmt::format("Integral over the unit square of {}; RMSE over {} sequences",
                                         integrand.formula, kSequences),
                             c, integrand.exact));
        fits.rows.push_back(slopes(integrand.name, c));
    }
    const Convergence box = renderBox(lab, options.seed);
    tables.push_back(
        convergenceTable("cornell-box",
                         fmt::format("The Cornell box, {0}x{0} pixels; RMSE by the differences of {1} seeds",
                                     kSamplerImageHeight, kImageSeeds),
                         box, {}));
    fits.rows.push_back(slopes("cornell-box", box));
    fits.notes = {
        "Independent numbers: -0.5, whatever the integrand. Sobol's points, Owen-scrambled: up to -1.5 where "
        "the integrand is smooth, less where it jumps, and in between for paths, where dimensions and edges "
        "are many."};
    tables.push_back(std::move(fits));
    return tables;
}

} // namespace lavalight
