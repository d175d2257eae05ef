#include "cli/options/shader_options.h"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/log.h"

namespace lavalight {
namespace {

constexpr const char* kOwnFolder = "shaders"; // folder of shaders in the source tree

bool isInSourceTree() {
    return std::filesystem::is_regular_file(std::filesystem::path(kOwnFolder) / "kernels/path.comp");
}

} // namespace

ShaderOptions::ShaderOptions(CLI::App& parser) {
    parser
        .add_option("--shaders", folder_,
                    "Folder of shader files that stand in for those of the same path (see new-experiment)")
        ->type_name("DIR");
}

void ShaderOptions::declareWatch(CLI::App& parser) {
    parser.add_flag("--watch", isWatching_,
                    "Render again whenever a file of --shaders (default: ./shaders) is saved, until Ctrl-C");
}

void ShaderOptions::watchIfThere() {
    isWatching_ = isWatching_ || !folder_.empty() || isInSourceTree();
}

std::string ShaderOptions::folder() const {
    if (!folder_.empty() || !isWatching_)
        return folder_;
    if (!isInSourceTree())
        throw UsageError("--watch: there is no folder of shaders here; give --shaders DIR (lavalight "
                         "new-experiment makes one)");
    return kOwnFolder;
}

void ShaderOptions::addFiles(InputFiles& inputs) const {
    if (folder_.empty() && !(isWatching_ && isInSourceTree()))
        return;
    std::error_code ended; // a folder that cannot be read is told of by overlay()
    for (std::filesystem::recursive_directory_iterator entry(folder(), ended), end; !ended && entry != end;
         entry.increment(ended))
        inputs.add(entry->path(), "one of the shaders");
}

std::shared_ptr<ShaderOverlay> ShaderOptions::overlay() const {
    const std::string where = folder();
    if (where.empty())
        return nullptr;
    auto overlay = std::make_shared<ShaderOverlay>(where);
    for (const std::string& path : overlay->unused())
        spdlog::warn("{}/{}: no kernel includes a file of that path", where, path);
    return overlay;
}

std::shared_ptr<ShaderOverlay> ShaderOptions::reread(const std::vector<std::string>& changes,
                                                     const RenderSession& session,
                                                     const RenderJob& job) const {
    spdlog::info("saved: {}", fmt::join(changes, ", "));
    try {
        std::shared_ptr<ShaderOverlay> now = overlay();
        const std::vector<std::string> names = session.changedKernels(job, sourceOf(now));
        if (!names.empty()) {
            spdlog::info("changed: {}", fmt::join(names, ", "));
            return now;
        }
        spdlog::info("no kernel has changed");
    } catch (const Error& error) {
        spdlog::error("{}\nthe kernels from before go on", error.what());
    }
    return nullptr;
}

} // namespace lavalight
