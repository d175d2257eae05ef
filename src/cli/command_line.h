// The command line: declares the subcommands, parses, and runs the chosen one.
#pragma once

#include <memory>
#include <optional>
#include <ostream>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/command.h"

namespace lavalight {

class CommandLine {
  public:
    CommandLine();
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    // Parses, once. Returns the exit code where help or the version was all that was asked for, which goes to
    // `help`. Throws UsageError, with the remedy, for what is not understood.
    [[nodiscard]] std::optional<int> parse(int argc, const char* const* argv, std::ostream& help);
    // The exit code of what run() throws.
    [[nodiscard]] int failureCode() const;
    // Runs the chosen command and returns its exit code.
    [[nodiscard]] int run();

  private:
    [[nodiscard]] Command* chosen() const; // null: none

    std::unique_ptr<CLI::App> app_; // the commands point into it
    std::vector<std::unique_ptr<Command>> commands_;
};

} // namespace lavalight
