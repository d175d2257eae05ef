// `lavalight devices`: every Vulkan device with the reasons why it would be refused.
#pragma once

#include "cli/command.h"

namespace lavalight {

class DevicesCommand : public Command {
  public:
    explicit DevicesCommand(CLI::App& app);
    // 1 if no device can render.
    [[nodiscard]] int run() override;

  private:
    bool json_ = false;
};

} // namespace lavalight
