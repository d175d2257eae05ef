// The command line: declares the subcommands, runs the chosen one, and turns failures into one line and an
// exit code.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/bench_command.h"
#include "app/compare_command.h"
#include "app/devices_command.h"
#include "app/info_command.h"
#include "app/lab_command.h"
#include "app/merge_command.h"
#include "app/new_experiment_command.h"
#include "app/presets_command.h"
#include "app/render_command.h"
#include "app/trace_command.h"
#include "app/view_command.h"
#include "base/error.h"
#include "base/log.h"
#include "base/version.h"

namespace lavalight {
namespace {

constexpr int kWrongUsage = 2;

// File names and library messages may hold line breaks; a message is one line.
void reportError(std::string message) {
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    spdlog::error("{}", message);
}

std::string commandNames(const CLI::App& app) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names += (names.empty() ? "" : ", ") + command->get_name();
    return names;
}

// What the parser says, with the remedy. Words that nobody takes come in order; before any command, the first
// was most likely meant as one.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error) {
    const auto chosen = app.get_subcommands();
    std::string message = error.what();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
        message = fmt::format("not understood: {}", fmt::join(app.remaining(true), " "));
    if (!chosen.empty())
        return fmt::format("{} (see lavalight {} --help)", message, chosen.front()->get_name());
    return fmt::format("{} (see lavalight --help; commands: {})", message, commandNames(app));
}

// `failureCode` becomes that of the command, before it runs.
template <size_t N>
int runChosen(const CLI::App& app, const std::array<std::unique_ptr<Command>, N>& commands,
              int& failureCode) {
    const auto command =
        std::find_if(commands.begin(), commands.end(), [](const auto& c) { return c->chosen(); });
    if (command == commands.end()) {
        fmt::print(stderr, "{}", app.help());
        return kWrongUsage;
    }
    failureCode = (*command)->failureCode();
    return (*command)->run();
}

int parseAndRun(int argc, char** argv, int& failureCode) {
    CLI::App app(
        "Lavalight: a physically based path tracer for glTF 2.0 on any Vulkan device, lavapipe included",
        "lavalight");
    app.set_version_flag("--version", fmt::format("lavalight {}", kVersion));
    app.require_subcommand(0, 1);
    app.option_defaults()->always_capture_default();
    const auto commands = std::to_array<std::unique_ptr<Command>>({
        std::make_unique<RenderCommand>(app),
        std::make_unique<ViewCommand>(app),
        std::make_unique<PresetsCommand>(app),
        std::make_unique<TraceCommand>(app),
        std::make_unique<LabCommand>(app),
        std::make_unique<NewExperimentCommand>(app),
        std::make_unique<InfoCommand>(app),
        std::make_unique<DevicesCommand>(app),
        std::make_unique<CompareCommand>(app),
        std::make_unique<MergeCommand>(app),
        std::make_unique<BenchCommand>(app),
    });
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        throw UsageError(usageMessage(app, error));
    }
    return runChosen(app, commands, failureCode);
}

// Results may end on a full disk.
void requireResultsWritten() {
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw Error("cannot write the results to stdout");
}

int run(int argc, char** argv) {
    configureLog(LogLevel::normal);
    int failureCode = 1;
    try {
        const int exitCode = parseAndRun(argc, argv, failureCode);
        requireResultsWritten();
        return exitCode;
    } catch (const UsageError& error) {
        reportError(error.what());
        return kWrongUsage;
    } catch (const Error& error) {
        reportError(error.what());
    } catch (const std::bad_alloc&) {
        reportError("out of memory");
    } catch (const std::exception& error) {
        reportError(fmt::format("unexpected failure: {}", error.what()));
    }
    return failureCode;
}

} // namespace
} // namespace lavalight

int main(int argc, char** argv) {
    return lavalight::run(argc, argv);
}
