// The options of a picture: what is shown, how it is rendered, and what it looks like.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/options/background_options.h"
#include "cli/options/crop_options.h"
#include "cli/options/denoise_options.h"
#include "cli/options/ground_options.h"
#include "cli/options/layer_options.h"
#include "cli/options/render_options.h"
#include "cli/options/scene_options.h"
#include "cli/options/tone_options.h"
#include "session/render_session.h"

namespace lavalight {

// Declares options on a parser and turns their values into a plan. Must outlive the parsing; the parser
// points into it.
class PictureOptions {
  public:
    explicit PictureOptions(CLI::App& parser);
    PictureOptions(const PictureOptions&) = delete;
    PictureOptions& operator=(const PictureOptions&) = delete;

    // For a scene by name or path. Loads the denoiser if it is asked for. Throws Error, and UsageError naming
    // the option and what it takes.
    [[nodiscard]] RenderPlan plan(const std::string& scene) const;
    [[nodiscard]] const SceneOptions& scene() const { return scene_; }
    [[nodiscard]] uint32_t layers() const { return layers_.layers(); }
    // Whether options were given that only a picture for displays shows.
    [[nodiscard]] bool hasBackdrop() const { return background_.backdrop().has_value(); }
    [[nodiscard]] bool hasTone() const { return tone_.isGiven(); }

  private:
    RenderOptions options_;
    CropOptions crop_;
    SceneOptions scene_;
    ToneOptions tone_;
    BackgroundOptions background_;
    GroundOptions ground_;
    LayerOptions layers_;
    DenoiseOptions denoise_;
};

} // namespace lavalight
