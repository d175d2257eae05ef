// What every subcommand is: it declares its options when constructed and does its work when run.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace lavalight {

// A command owns the values of its options, so it must outlive the parsing; it neither moves nor copies,
// since the parser points into it. main keeps one of each, parses, then runs the chosen one.
class Command {
  public:
    Command(CLI::App& app, const std::string& name, const std::string& description);
    virtual ~Command() = default;
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    // Whether the command line named this command.
    [[nodiscard]] bool chosen() const { return parser_.parsed(); }

    // The exit code: 0 done, 1 failed, 130 interrupted. Throws Error (exit failureCode()) or UsageError (exit
    // 2).
    [[nodiscard]] virtual int run() = 0;
    // The exit code of whatever is thrown.
    [[nodiscard]] virtual int failureCode() const { return 1; }

  protected:
    [[nodiscard]] CLI::App& parser() { return parser_; }
    [[nodiscard]] const CLI::App& parser() const { return parser_; }
    // A command of this command.
    [[nodiscard]] CLI::App& addSubcommand(const std::string& name, const std::string& description);

  private:
    CLI::App& parser_;
};

} // namespace lavalight
