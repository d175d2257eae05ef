// `lavalight new-experiment`: a shader file to change, in a folder of its own.
#pragma once

#include <string>

#include "cli/command.h"

namespace lavalight {

class NewExperimentCommand : public Command {
  public:
    explicit NewExperimentCommand(CLI::App& app);
    // Copies the embedded file to FOLDER/FILE and adds a README.md. Throws UsageError for a file that does
    // not exist, Error where either is there already.
    [[nodiscard]] int run() override;

  private:
    std::string folder_;
    std::string file_;
};

} // namespace lavalight
