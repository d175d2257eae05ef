#include "split/split_job.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "base/version.h"
#include "split/split_scripts.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kJobFile = "job.json";

} // namespace

void writeSplitJob(const SplitPlan& plan, const std::string& sceneName, const fs::path& folder) {
    for (const SplitScript& script : scriptsOf(plan)) {
        writeFileAtomically(folder / script.name, script.text);
        if (script.isProgram)
            fs::permissions(folder / script.name,
                            fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                            fs::perm_options::add);
    }
    fs::create_directories(folder / kRunningFolder);
    Json json = {{"lavalight", versionText()},
                 {"scene", sceneName},
                 {"parts", plan.parts},
                 {"samples", {plan.samples.first, plan.samples.end}},
                 {"checkpointSeconds", plan.checkpointSeconds},
                 {"options", plan.words}};
    if (plan.frames)
        json["frames"] = {plan.frames->first, plan.frames->end};
    writeFileAtomically(folder / kJobFile, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

SplitJob readSplitJob(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw Error(fmt::format("cannot read {}: it is not a directory", folder.string()));
    if (!fs::exists(folder / kJobFile))
        throw Error(fmt::format("cannot read {}: it has no {}, which lavalight split writes", folder.string(),
                                kJobFile));
    const Json json = Json::parse(readFile(folder / kJobFile), nullptr, false);
    if (!json.is_object() || !json.contains("checkpointSeconds") || !json["checkpointSeconds"].is_number())
        throw Error(fmt::format("cannot read {}: it is not what lavalight split writes",
                                (folder / kJobFile).string()));
    return {json["checkpointSeconds"].get<double>()};
}

} // namespace lavalight
