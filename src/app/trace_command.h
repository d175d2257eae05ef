// `lavalight trace`: one path of a render, vertex by vertex, as JSON.
#pragma once

#include <string>

#include "app/command.h"
#include "app/render_options.h"
#include "app/scene_options.h"
#include "app/shader_options.h"

namespace lavalight {

class TraceCommand : public Command {
  public:
    explicit TraceCommand(CLI::App& app);
    [[nodiscard]] int run() override;

  private:
    [[nodiscard]] glm::uvec2 pixelIn(const RenderSettings& settings) const;

    RenderOptions options_;
    SceneOptions sceneOptions_;
    ShaderOptions shaders_;
    std::string scene_ = "cornell-box";
    std::string pixel_;
    uint32_t sample_ = 0;
};

} // namespace lavalight
