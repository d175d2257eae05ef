// One image in the making, and what its making took.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

struct Take {
    Stopwatch watch{};
    Scene scene;
    std::unique_ptr<Renderer> renderer{};
    RenderReport report{};
    std::optional<double>
        toFirstSamples{}; // seconds from the start of the process to the end of the first wave
    FilmCost before{};    // what the samples cost that a checkpoint brought

    // The inputs of the report: scene, settings, device, content.
    void describeInputs(const gpu::Device& device, const std::vector<std::string>& changedShaders);
    // Renders, and asks with the fraction done after each wave; false ends it.
    void takeSamples(const std::function<bool(double fraction)>& mayGoOn);

    // The film as it is, with its header; it needs describeInputs().
    [[nodiscard]] FilmFile film() const;
    // Goes on from the checkpoint, if there is one. Throws Error where it is of another image.
    void resumeFrom(Checkpoint& checkpoint);
    // Writes the film of a render under way into the checkpoint.
    void keep(Checkpoint& checkpoint);
};

} // namespace lavalight
