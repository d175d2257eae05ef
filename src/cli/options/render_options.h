// The options of a render, shared by every command that renders.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/options/camera_options.h"
#include "cli/options/device_options.h"
#include "cli/options/environment_options.h"
#include "render/settings.h"
#include "session/render_session.h"

namespace lavalight {

// Declares options on a parser and turns their values into settings. Must outlive the parsing; the parser
// points into it.
class RenderOptions {
  public:
    explicit RenderOptions(CLI::App& parser);
    RenderOptions(const RenderOptions&) = delete;
    RenderOptions& operator=(const RenderOptions&) = delete;

    // Throws UsageError naming the option and what it takes.
    [[nodiscard]] RenderSettings settings() const;
    [[nodiscard]] gpu::DeviceConfig device() const;
    // Whether the image is to hold its exact film.
    [[nodiscard]] bool keepsFilm() const { return !samples_.empty(); }
    // All of it, for a scene by name or path; how images are written is left open.
    [[nodiscard]] RenderPlan plan(const std::string& scene) const;

  private:
    void declareImage(CLI::App& parser);
    void declareStop(CLI::App& parser);
    void declareEstimator(CLI::App& parser);
    void declareRoulette(CLI::App& parser);
    void declareDevice(CLI::App& parser);
    void takeRange(RenderSettings& settings) const;

    CLI::App* parser_; // asked which options were given
    std::string size_;
    std::string samples_; // A:B
    CameraOptions camera_;
    EnvironmentOptions environment_;
    std::string preset_;
    std::string clampIndirect_ = "off";
    EstimatorSettings estimator_; // values of the options; those not given are taken from the preset
    RenderSettings settings_;
    std::optional<DeviceOptions> device_; // always, once declared
};

} // namespace lavalight
