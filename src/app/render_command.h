// `lavalight render`: a scene in, an image out.
#pragma once

#include <string>

#include "app/command.h"
#include "app/render_options.h"

namespace lavalight {

class RenderCommand : public Command {
  public:
    explicit RenderCommand(CLI::App& app);
    // Renders and writes the files asked for; 130 if interrupted, with the image so far written.
    [[nodiscard]] int run() override;

  private:
    void requireOutputs() const;

    RenderOptions options_;
    std::string scene_ = "cornell-box";
    std::string exr_;
    std::string png_;
    std::string report_;
    float exposure_ = 0.0f;
    bool quiet_ = false;
};

} // namespace lavalight
