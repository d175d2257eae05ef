#include "cli/commands/presets_command.h"

#include <fmt/format.h>

#include "render/presets.h"

namespace lavalight {

int PresetsCommand::run() {
    for (const Preset& preset : presets())
        fmt::print("{:<10} {}\n{:<10} {}\n", preset.name, preset.meaning, "", optionsOf(preset));
    return 0;
}

} // namespace lavalight
