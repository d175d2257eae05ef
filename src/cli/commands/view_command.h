// `lavalight view`: the window.
#pragma once

#include <string>

#include "cli/command.h"
#include "cli/options/background_options.h"
#include "cli/options/denoise_options.h"
#include "cli/options/ground_options.h"
#include "cli/options/render_options.h"
#include "cli/options/scene_options.h"
#include "cli/options/shader_options.h"
#include "cli/options/tone_options.h"

namespace lavalight {

class ViewCommand : public Command {
  public:
    explicit ViewCommand(CLI::App& app);
    [[nodiscard]] int run() override;

  private:
    [[nodiscard]] RenderPlan plan();

    RenderOptions options_;
    SceneOptions sceneOptions_;
    ShaderOptions shaders_;
    ToneOptions tone_;
    BackgroundOptions background_;
    GroundOptions ground_;
    DenoiseOptions denoise_;
    std::string scene_ = "cornell-box";
    bool isNotWatching_ = false;
};

} // namespace lavalight
