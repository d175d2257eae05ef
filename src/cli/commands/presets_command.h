// `lavalight presets`: the steps of the lecture with what each sets.
#pragma once

#include "cli/command.h"

namespace lavalight {

class PresetsCommand : public Command {
  public:
    explicit PresetsCommand(CLI::App& app)
        : Command(app, "presets", "List the named settings of render --preset") {}
    [[nodiscard]] int run() override;
};

} // namespace lavalight
