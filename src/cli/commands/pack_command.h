// `lavalight pack`: a scene file and all that it refers to, as one .glb.
#pragma once

#include <string>

#include "cli/command.h"
#include "gltf/import_options.h"

namespace lavalight {

class PackCommand : public Command {
  public:
    explicit PackCommand(CLI::App& app);
    [[nodiscard]] int run() override;

  private:
    std::string scene_;
    std::string output_;
    ImportOptions options_;
};

} // namespace lavalight
