// `lavalight devices`: every Vulkan device with the reasons why it would be refused.
#pragma once

#include "cli/command.h"

namespace lavalight {

class DevicesCommand : public Command {
  public:
    explicit DevicesCommand(CLI::App& app);
    // Prints the devices; the exit code is 1 if none can render.
    [[nodiscard]] int run() override;

  private:
    bool json_ = false;
};

} // namespace lavalight
