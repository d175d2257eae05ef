// `lavalight status`: how far the parts of a split render are.
#pragma once

#include <string>

#include "cli/command.h"

namespace lavalight {

class StatusCommand : public Command {
  public:
    explicit StatusCommand(CLI::App& app);
    [[nodiscard]] int run() override;

  private:
    std::string folder_;
    bool isJson_ = false;
};

} // namespace lavalight
