#include "cli/command_line.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/version.h"
#include "cli/commands/bench_command.h"
#include "cli/commands/compare_command.h"
#include "cli/commands/devices_command.h"
#include "cli/commands/info_command.h"
#include "cli/commands/lab_command.h"
#include "cli/commands/merge_command.h"
#include "cli/commands/new_experiment_command.h"
#include "cli/commands/pack_command.h"
#include "cli/commands/presets_command.h"
#include "cli/commands/render_command.h"
#include "cli/commands/serve_command.h"
#include "cli/commands/split_command.h"
#include "cli/commands/status_command.h"
#include "cli/commands/trace_command.h"
#include "cli/commands/view_command.h"
#include "cli/help_formatter.h"

namespace lavalight {
namespace {

constexpr int kWrongUsage = 2;

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

} // namespace

CommandLine::CommandLine()
    : app_(std::make_unique<CLI::App>(
          "Lavalight: a physically based path tracer for glTF 2.0 on any Vulkan device, lavapipe included",
          "lavalight")) {
    CLI::App& app = *app_;
    app.set_version_flag("--version", fmt::format("lavalight {}", versionText()));
    app.formatter(std::make_shared<HelpFormatter>()); // before the commands, which inherit it
    app.require_subcommand(0, 1);
    app.option_defaults()->always_capture_default();
    commands_.push_back(std::make_unique<RenderCommand>(app));
    commands_.push_back(std::make_unique<ViewCommand>(app));
    commands_.push_back(std::make_unique<ServeCommand>(app));
    commands_.push_back(std::make_unique<PresetsCommand>(app));
    commands_.push_back(std::make_unique<TraceCommand>(app));
    commands_.push_back(std::make_unique<LabCommand>(app));
    commands_.push_back(std::make_unique<NewExperimentCommand>(app));
    commands_.push_back(std::make_unique<InfoCommand>(app));
    commands_.push_back(std::make_unique<DevicesCommand>(app));
    commands_.push_back(std::make_unique<CompareCommand>(app));
    commands_.push_back(std::make_unique<MergeCommand>(app));
    commands_.push_back(std::make_unique<SplitCommand>(app));
    commands_.push_back(std::make_unique<StatusCommand>(app));
    commands_.push_back(std::make_unique<PackCommand>(app));
    commands_.push_back(std::make_unique<BenchCommand>(app));
}

CommandLine::~CommandLine() = default;

std::optional<int> CommandLine::parse(int argc, const char* const* argv, std::ostream& help) {
    try {
        app_->parse(argc, argv);
    } catch (const CLI::Success& asked) {
        return app_->exit(asked, help, help);
    } catch (const CLI::ParseError& error) {
        throw UsageError(usageMessage(*app_, error));
    }
    return std::nullopt;
}

Command* CommandLine::chosen() const {
    const auto command =
        std::find_if(commands_.begin(), commands_.end(), [](const auto& c) { return c->chosen(); });
    return command == commands_.end() ? nullptr : command->get();
}

int CommandLine::failureCode() const {
    const Command* command = chosen();
    return command == nullptr ? kWrongUsage : command->failureCode();
}

int CommandLine::run() {
    if (Command* command = chosen())
        return command->run();
    fmt::print(stderr, "{}", app_->help());
    return kWrongUsage;
}

} // namespace lavalight
