// The folder of a split render, and what it says of itself.
#pragma once

#include <filesystem>
#include <string>

#include "split/split_plan.h"

namespace lavalight {

// What job.json holds for other commands; the scripts need nothing of it.
struct SplitJob {
    double checkpointSeconds = 60.0;
};

// Writes parts.txt, the scripts, job.json and empty folders for parts into `folder`, which exists.
void writeSplitJob(const SplitPlan& plan, const std::string& sceneName, const std::filesystem::path& folder);

// Throws Error for a folder that has no job.json of ours.
[[nodiscard]] SplitJob readSplitJob(const std::filesystem::path& folder);

} // namespace lavalight
