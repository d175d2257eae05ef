#include "cli/command.h"

namespace lavalight {

// Neither function is in the header: whoever constructs a CLI::App compiles all of CLI11, ten seconds a file.
Command::Command(CLI::App& app, const std::string& name, const std::string& description)
    : parser_(*app.add_subcommand(name, description)) {}

CLI::App& Command::addSubcommand(const std::string& name, const std::string& description) {
    return *parser_.add_subcommand(name, description);
}

} // namespace lavalight
