// `lavalight trace`: one path of a render, vertex by vertex, as JSON.
#pragma once

#include <string>

#include "cli/command.h"
#include "cli/options/ground_options.h"
#include "cli/options/render_options.h"
#include "cli/options/scene_options.h"
#include "cli/options/shader_options.h"

namespace lavalight {

class TraceCommand : public Command {
  public:
    explicit TraceCommand(CLI::App& app);
    [[nodiscard]] int run() override;

  private:
    [[nodiscard]] glm::uvec2 pixelIn(const RenderSettings& settings) const;

    RenderOptions options_;
    SceneOptions sceneOptions_;
    GroundOptions ground_;
    ShaderOptions shaders_;
    std::string scene_ = "cornell-box";
    std::string pixel_;
    uint32_t sample_ = 0;
};

} // namespace lavalight
