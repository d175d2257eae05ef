// A render that is split into parts, which any machine may render: what each part is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "film/sample_ranges.h"

namespace lavalight {

// What runs the parts.
enum class SplitEngine { shell, slurm, github };

struct SplitFrames {
    uint32_t first = 0;
    uint32_t end = 0; // the first that is not rendered
};

// Words are those of `lavalight render`, unquoted.
struct SplitPlan {
    std::string scene;                     // as the scripts name it: built in, or a file of the job's folder
    std::vector<std::string> words;        // options of every part, and of the PNG
    std::vector<std::string> partWords;    // further options of the parts
    std::vector<std::string> pictureWords; // further options of the PNG
    SampleRange samples{0, 64};
    uint32_t parts = 1;                // parts of each frame
    std::optional<SplitFrames> frames; // none: one picture
    double checkpointSeconds = 60.0;
    bool hasPng = false;               // the merged film becomes a PNG, too
    bool isStatistical = false;        // kinds of machine may differ
    bool hasThreads = false;           // `words` say how many threads a part has
    std::string program = "lavalight"; // what the scripts call
    std::string constraint;            // feature that Slurm's nodes must have; empty: any node
    SplitEngine engine = SplitEngine::shell;
    std::string folder; // the job's folder, as the user named it
};

struct SplitPart {
    std::string name; // file name without ending
    std::vector<std::string> words;
    std::optional<uint32_t> frame;
};

// In the order of their numbers: all parts of the first frame, then those of the next.
[[nodiscard]] std::vector<SplitPart> partsOf(const SplitPlan& plan);

// Throws UsageError where the samples do not suffice for the parts, or the parts are too many for the engine.
void requirePossible(const SplitPlan& plan);

// A word as a shell has to read it.
[[nodiscard]] std::string shellQuoted(const std::string& word);

} // namespace lavalight
