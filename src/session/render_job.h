// One image in the making: its scene, its renderer, and what its making took.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "session/checkpoint.h"
#include "session/film_record.h"
#include "session/report.h"

namespace lavalight {

// Splits the time of a run into named stages.
class Stopwatch {
  public:
    // Seconds since the last call, kept under that name.
    double lap(const std::string& stage);
    [[nodiscard]] double sinceLap() const;
    [[nodiscard]] const StageTimes& stages() const { return stages_; }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    StageTimes stages_;
};

struct RenderJob {
    // Asked after each wave with the fraction done, in [0, 1]; false ends the render.
    using KeepGoing = std::function<bool(double fraction)>;

    Stopwatch watch{};
    const gpu::Device* device = nullptr; // outlives the job
    Scene scene{};
    Camera camera{};
    std::unique_ptr<Renderer> renderer{};
    RenderReport report{};
    // Seconds from the start of the process to the end of the first wave.
    std::optional<double> toFirstSamples{};
    bool writesExr = true; // whether an image of the job says which machine its samples are of
    FilmCost before{};     // what the samples cost that a checkpoint brought

    // Enters scene, settings, device and content into the report; shaders may have changed since the renderer
    // was made.
    void describeInputs(const std::vector<std::string>& changedShaders);
    void takeSamples(const KeepGoing& keepGoing);

    // The film as it is, with its header; it needs describeInputs().
    [[nodiscard]] FilmFile film() const;
    // Goes on from the checkpoint, if there is one. Throws Error where it is of another image.
    void resumeFrom(Checkpoint& checkpoint);
    // Writes the film of a render under way into the checkpoint.
    void keep(Checkpoint& checkpoint);
};

} // namespace lavalight
