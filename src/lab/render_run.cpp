#include "lab/render_run.h"

#include <algorithm>
#include <cmath>

namespace lavalight {
namespace {

double meanOfChannels(const glm::vec3& v) {
    return (double{v.x} + double{v.y} + double{v.z}) / 3.0;
}

double deviationOfChannels(const glm::vec3& variance) {
    return (std::sqrt(double{variance.x}) + std::sqrt(double{variance.y}) + std::sqrt(double{variance.z})) /
           3.0;
}

// Fills in what the film says of those pixels. Deviations of a pixel's channels are added, not their squares:
// they share their paths.
void addFilm(RenderRun& run, const Rendering& rendering, const std::vector<size_t>& measured) {
    const auto pixels = static_cast<double>(measured.size());
    double squares = 0.0;
    for (const size_t i : measured) {
        const double deviation = deviationOfChannels(rendering.variance().pixels[i]);
        squares += deviation * deviation;
        run.mean += meanOfChannels(rendering.radiance().pixels[i]) / pixels;
        run.variance += meanOfChannels(rendering.variance().pixels[i]) * rendering.sampleCounts[i] / pixels;
    }
    run.standardError = std::sqrt(squares) / pixels;
    run.paths += rendering.samples();
}

// Whether the pixel or one of the eight around it has emission: samples find even a light that barely reaches
// into a pixel in the next one.
bool seesLight(const Image& emission, uint32_t x, uint32_t y) {
    for (uint32_t j = y > 0 ? y - 1 : 0; j <= std::min(y + 1, emission.height - 1); ++j)
        for (uint32_t i = x > 0 ? x - 1 : 0; i <= std::min(x + 1, emission.width - 1); ++i)
            if (emission.at(i, j) != glm::vec3(0.0f))
                return true;
    return false;
}

std::vector<size_t> pixelsWithoutLight(const Image& emission) {
    std::vector<size_t> pixels;
    for (uint32_t y = 0; y < emission.height; ++y)
        for (uint32_t x = 0; x < emission.width; ++x)
            if (!seesLight(emission, x, y))
                pixels.push_back(size_t{y} * emission.width + x);
    return pixels;
}

RenderPlan planOf(const std::string& scene) {
    RenderPlan plan;
    plan.scene = scene;
    return plan;
}

constexpr uint32_t kEmissionSamples = 64; // a pixel: enough to find the lights in it

} // namespace

double RenderRun::raysPerPath() const {
    return static_cast<double>(rays.camera + rays.indirect) / static_cast<double>(paths);
}

double RenderRun::efficiency() const {
    const double cost = variance / static_cast<double>(samples) * seconds;
    return cost > 0.0 ? 1.0 / cost : 0.0;
}

RenderBench::RenderBench(const LabDevice& lab, const std::string& scene, uint32_t height)
    : lab_(lab), session_(planOf(scene), lab.device) {
    image_.height = height;
    EstimatorSettings emissionOnly = independentSettings(0);
    emissionOnly.maxBounces = 0;
    RenderJob job = render(settings(emissionOnly, kEmissionSamples));
    image_ = job.renderer->settings().image; // with the width
    measured_ = pixelsWithoutLight(job.renderer->rendering().radiance());
    finish(std::move(job));
}

RenderSettings RenderBench::settings(const EstimatorSettings& estimator, uint32_t samples) const {
    RenderSettings settings;
    settings.estimator = estimator;
    settings.image = image_;
    settings.stop.samples = samples;
    return settings;
}

RenderJob RenderBench::render(const RenderSettings& settings, const Look& look) {
    session_.use(settings);
    RenderJob job = session_.prepare({}, {});
    job.takeSamples([&](double fraction) {
        lab_.look();
        if (look)
            look(fraction, *job.renderer);
        return true;
    });
    return job;
}

RenderRun RenderBench::measure(const EstimatorSettings& estimator, uint32_t samples) {
    RenderJob job = render(settings(estimator, samples));
    RenderRun run;
    run.seconds = job.report.renderSeconds;
    run.samples = samples;
    run.rays = job.renderer->waves().rays();
    addFilm(run, job.renderer->rendering(), measured_);
    finish(std::move(job));
    return run;
}

EstimatorSettings independentSettings(uint32_t seed) {
    EstimatorSettings settings;
    settings.sampler = Sampler::independent;
    settings.seed = seed;
    return settings;
}

void RenderTable::add(const std::string& name, const EstimatorSettings& estimator) {
    const RenderRun run = bench_->measure(estimator, samples_);
    EstimatorRow row{name, run.samples, run.mean, {}, run.standardError, run.variance, {}, 1.0, {}};
    const double shadowRays = static_cast<double>(run.rays.shadow) / static_cast<double>(run.paths);
    row.more = {run.raysPerPath(), shadowRays, run.seconds, run.efficiency()};
    rows_.push_back(row);
}

Table RenderTable::table(const std::string& name, const std::string& title) const {
    Table table = estimatorTable(name, title, rows_,
                                 {{"raysPerPath", "rays a path"},
                                  {"shadowRaysPerPath", "shadow rays"},
                                  {"seconds", "seconds"},
                                  {"efficiency", "efficiency"}});
    table.notes = {"Means over channels and over the pixels that see no light itself; samples are per pixel; "
                   "the variance is that of "
                   "one sample, by the film; efficiency is 1 / (variance of a pixel's mean * seconds). "
                   "Seconds differ from run to run, "
                   "all else repeats."};
    return table;
}

} // namespace lavalight
