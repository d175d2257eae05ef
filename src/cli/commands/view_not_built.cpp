// `lavalight view` where the window is not built (CMake's option LAVALIGHT_VIEW is off): the command says so.
#include "base/error.h"
#include "cli/commands/view_command.h"

namespace lavalight {

ViewCommand::ViewCommand(CLI::App& app)
    : Command(app, "view", "Show a scene in a window (not built into this program)"), options_(parser()),
      sceneOptions_(parser()), shaders_(parser()), tone_(parser()) {
    parser().allow_extras(); // whatever they are, the answer is the same
}

int ViewCommand::run() {
    throw Error("cannot view: this lavalight was built without its window; configure it with "
                "-DLAVALIGHT_VIEW=ON, or render to a file: lavalight render");
}

} // namespace lavalight
