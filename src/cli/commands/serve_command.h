// `lavalight serve`, which is a command of the Python package: this program says so.
#pragma once

#include "cli/command.h"

namespace lavalight {

class ServeCommand : public Command {
  public:
    explicit ServeCommand(CLI::App& app);
    [[nodiscard]] int run() override;
};

} // namespace lavalight
