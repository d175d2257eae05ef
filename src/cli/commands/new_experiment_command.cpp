#include "cli/commands/new_experiment_command.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/file.h"
#include "base/version.h"
#include "kernels/shader_overlay.h"

namespace lavalight {
namespace {

// Paths of the files that a render uses. Headers of shared/ are not for experiments: the program's own memory
// is laid out by them.
std::vector<std::string> filesToChange() {
    std::vector<std::string> paths = embeddedShaderPaths();
    std::erase_if(paths, [](const std::string& path) {
        return path.starts_with("shared/") || path.starts_with("kernels/lab/");
    });
    return paths;
}

std::string readmeText(const std::string& folder, const std::string& file) {
    return fmt::format(
        "# An experiment with {1}\n\n"
        "`{1}` is a copy of the file that Lavalight {2} renders with. Change it, then compare:\n\n"
        "    lavalight render cornell-box -o before.exr\n"
        "    lavalight render cornell-box -o after.exr --shaders {0}\n"
        "    lavalight compare after.exr before.exr\n\n"
        "With `--watch` the image is rendered again at every save, and what does not compile is told with "
        "its\n"
        "file and line:\n\n"
        "    lavalight render cornell-box --png picture.png --shaders {0} --watch\n\n"
        "- Signatures and structs that other files use must stay; what a function does is yours.\n"
        "- `lavalight new-experiment {0} FILE` adds another file; `lavalight new-experiment --help` lists "
        "them.\n"
        "- Files of `shared/` cannot be changed so: the program was built with them.\n"
        "- A change that keeps the mean (another sampling, another weight) must pass `compare`'s Z-test; "
        "the\n"
        "  image's header and its bias ledger name the changed files.\n",
        folder, file, kVersion);
}

} // namespace

NewExperimentCommand::NewExperimentCommand(CLI::App& app)
    : Command(app, "new-experiment", "Copy one of the shaders to a folder, to change it for --shaders") {
    parser()
        .add_option("folder", folder_, "Folder for --shaders; made if need be")
        ->required()
        ->type_name("DIR");
    parser()
        .add_option("file", file_, "Path below shaders/, such as lib/sampling/roulette.glsl")
        ->required()
        ->type_name("FILE");
}

int NewExperimentCommand::run() {
    namespace fs = std::filesystem;
    const std::vector<std::string> known = filesToChange();
    if (std::find(known.begin(), known.end(), file_) == known.end())
        throw UsageError(
            fmt::format("new-experiment: {} is not one of the shaders: {}", file_, fmt::join(known, ", ")));
    const fs::path copy = fs::path(folder_) / file_;
    if (fs::exists(copy))
        throw Error(fmt::format("cannot write {}: it exists already; give another folder", copy.string()));
    std::error_code failure;
    fs::create_directories(copy.parent_path(), failure);
    if (failure)
        throw Error(fmt::format("cannot create the directory {}: {}", copy.parent_path().string(),
                                failure.message()));
    writeFileAtomically(copy, *embeddedShader(file_));
    const fs::path readme = fs::path(folder_) / "README.md";
    if (!fs::exists(readme))
        writeFileAtomically(readme, readmeText(folder_, file_));
    fmt::print("{}\n", copy.string());
    return 0;
}

} // namespace lavalight
