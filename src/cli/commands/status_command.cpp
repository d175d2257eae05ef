#include "cli/commands/status_command.h"

#include <fmt/format.h>

#include "split/split_status.h"

namespace lavalight {

StatusCommand::StatusCommand(CLI::App& app)
    : Command(
          app, "status",
          "How far the parts of a split render are: done, running, stopped or missing, and the time left") {
    parser()
        .add_option("job", folder_, "Folder that lavalight split has written")
        ->type_name("JOB")
        ->default_str("")
        ->required();
    parser().add_flag("--json", isJson_, "Print JSON");
}

int StatusCommand::run() {
    const SplitStatus status = statusOf(folder_);
    fmt::print("{}", isJson_ ? jsonOf(status) : textOf(status));
    return 0;
}

} // namespace lavalight
