// `lavalight info`: what was understood of a scene, and what was not.
#pragma once

#include <string>

#include "cli/command.h"
#include "cli/options/scene_options.h"

namespace lavalight {

class InfoCommand : public Command {
  public:
    explicit InfoCommand(CLI::App& app);
    // Prints counts, cameras, extensions, bounds, memory and warnings of the scene.
    [[nodiscard]] int run() override;

  private:
    SceneOptions options_;
    std::string scene_;
    bool json_ = false;
};

} // namespace lavalight
