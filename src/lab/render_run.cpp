#include "lab/render_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/renderer.h"
#include "session/builtin.h"

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
        const double deviation = deviationOfChannels(rendering.variance.pixels[i]);
        squares += deviation * deviation;
        run.mean += meanOfChannels(rendering.radiance.pixels[i]) / pixels;
        run.variance += meanOfChannels(rendering.variance.pixels[i]) * rendering.sampleCounts[i] / pixels;
    }
    run.standardError = std::sqrt(squares) / pixels;
    for (const uint32_t count : rendering.sampleCounts)
        run.paths += count;
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

constexpr uint32_t kEmissionSamples = 64; // a pixel: enough to find the lights in it

} // namespace

double RenderRun::raysPerPath() const {
    return static_cast<double>(rays.camera + rays.indirect) / static_cast<double>(paths);
}

double RenderRun::efficiency() const {
    const double cost = variance / static_cast<double>(samples) * seconds;
    return cost > 0.0 ? 1.0 / cost : 0.0;
}

RenderBench::RenderBench(gpu::Device& device, const std::string& scene, uint32_t height)
    : device_(&device), scene_(loadScene(scene)), height_(height) {
    EstimatorSettings emissionOnly = independentSettings(0);
    emissionOnly.maxBounces = 0;
    Renderer renderer(device, scene_, scene_.cameras.front(), settings(emissionOnly, kEmissionSamples));
    renderer.render([](double) { return true; });
    measured_ = pixelsWithoutLight(renderer.rendering().radiance);
}

RenderSettings RenderBench::settings(const EstimatorSettings& estimator, uint32_t samples) const {
    RenderSettings settings;
    settings.estimator = estimator;
    settings.image.height = height_;
    settings.stop.samples = samples;
    settings = resolveSize(settings, scene_.cameras.front());
    checkSettings(settings);
    return settings;
}

RenderRun RenderBench::measure(const EstimatorSettings& estimator, uint32_t samples) const {
    Renderer renderer(*device_, scene_, scene_.cameras.front(), settings(estimator, samples));
    const auto start = std::chrono::steady_clock::now();
    renderer.render([](double) { return true; });
    RenderRun run;
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    run.samples = samples;
    run.rays = renderer.waves().rays();
    addFilm(run, renderer.rendering(), measured_);
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
