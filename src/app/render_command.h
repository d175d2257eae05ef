// `lavalight render`: a scene in, an image out.
#pragma once

#include <string>

#include "app/command.h"
#include "app/render_options.h"
#include "app/scene_options.h"
#include "image/image.h"
#include "render/report.h"

namespace lavalight {

class RenderCommand : public Command {
  public:
    explicit RenderCommand(CLI::App& app);
    // Renders and writes the files asked for; 130 if interrupted, with the image so far written.
    [[nodiscard]] int run() override;

  private:
    void requireOutputs() const;
    void writeImages(const Rendering& rendering, const RenderReport& report) const;

    RenderOptions options_;
    SceneOptions sceneOptions_;
    std::string scene_ = "cornell-box";
    std::string exr_;
    std::string png_;
    std::string report_;
    float exposure_ = 0.0f;
    bool quiet_ = false;
};

} // namespace lavalight
