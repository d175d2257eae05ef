// The files that run and join the parts of a split render: plain text, to be read and changed.
#pragma once

#include <string>
#include <vector>

#include "split/split_plan.h"

namespace lavalight {

struct SplitScript {
    std::string name; // in the job's folder
    std::string text;
    bool isProgram = false; // it may be run
};

// parts.txt with a line for each part, and the scripts of the engine.
[[nodiscard]] std::vector<SplitScript> scriptsOf(const SplitPlan& plan);

inline constexpr const char* kPartsList = "parts.txt";
inline constexpr const char* kPartsFolder = "parts";
inline constexpr const char* kRunningFolder = "parts/running";

} // namespace lavalight
