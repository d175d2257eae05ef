// `lavalight view` where the window is not built (CMake's option LAVALIGHT_VIEW is off): the command says so.
#include "base/error.h"
#include "cli/commands/view_command.h"

namespace lavalight {

int ViewCommand::run() {
    throw Error("cannot view: this lavalight was built without its window; configure it with "
                "-DLAVALIGHT_VIEW=ON, or render to a file: lavalight render");
}

} // namespace lavalight
