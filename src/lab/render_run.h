// A small render whose estimator is measured: mean, variance, rays, time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "film/film_cost.h"
#include "lab/lab_device.h"
#include "lab/table.h"
#include "render/settings.h"
#include "session/render_session.h"

namespace lavalight {

// Means are over channels and over the pixels that see no light source: the edge of a light in the picture is
// noise that no estimator of illumination changes, and bright enough to hide what does change.
struct RenderRun {
    uint64_t samples = 0; // per pixel
    double mean = 0.0;
    double standardError = 0.0; // upper bound, as if the channels of a pixel were one
    double variance = 0.0; // variance of a sample, by the film: only for Sampler::independent without bias
    double seconds = 0.0;
    uint64_t paths = 0;
    RayCounts rays;

    // Rays from the camera or a scattering vertex: how long a path is on average.
    [[nodiscard]] double raysPerPath() const;
    // 1 / (variance of a pixel's mean * time): how much is got for a second.
    [[nodiscard]] double efficiency() const;
};

class RenderBench {
  public:
    // `scene` is a built-in name or a file without environment; `height` in pixels, the width follows from
    // its camera.
    RenderBench(const LabDevice& lab, const std::string& scene, uint32_t height);

    [[nodiscard]] RenderRun measure(const EstimatorSettings& estimator, uint32_t samples);

    [[nodiscard]] RenderSettings settings(const EstimatorSettings& estimator, uint32_t samples) const;
    // Calls `look` between waves with the fraction done and the image so far.
    using Look = std::function<void(double fraction, const Renderer& renderer)>;
    // Renders the scene to the end, and returns the job until finish() takes it back.
    [[nodiscard]] RenderJob render(const RenderSettings& settings, const Look& look = {});
    void finish(RenderJob job) { session_.finish(std::move(job)); }

  private:
    LabDevice lab_;
    RenderSession session_;
    ImageSettings image_;
    std::vector<size_t> measured_; // indices of pixels
};

// Settings that differ from the defaults in the sampler alone, so that the film's variance is that of the
// estimator.
[[nodiscard]] EstimatorSettings independentSettings(uint32_t seed);

// Measures estimators one by one and gathers their rows; the first is the naive one.
class RenderTable {
  public:
    explicit RenderTable(RenderBench& bench, uint32_t samples) : bench_(&bench), samples_(samples) {}

    void add(const std::string& name, const EstimatorSettings& estimator);
    // Columns of an estimator's table, then rays per path, shadow rays per path, seconds, efficiency. Notes
    // start with what the figures are and are not.
    [[nodiscard]] Table table(const std::string& name, const std::string& title) const;

  private:
    RenderBench* bench_;
    uint32_t samples_;
    std::vector<EstimatorRow> rows_;
};

} // namespace lavalight
