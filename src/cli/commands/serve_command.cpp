#include "cli/commands/serve_command.h"

#include "base/error.h"

namespace lavalight {

ServeCommand::ServeCommand(CLI::App& app)
    : Command(app, "serve", "Render for browsers and for Drake over HTTP: a command of the Python package") {
    parser().allow_extras(); // the package's own options
}

int ServeCommand::run() {
    throw Error("cannot serve: this program has no server; install the Python package with its extra, "
                "lavalight[serve], and try python3 -m lavalight serve");
}

} // namespace lavalight
