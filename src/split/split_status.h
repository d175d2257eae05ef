// How far a split render is, by the files of its folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lavalight {

enum class PartState {
    done,
    running,
    stopped, // it began, and none of its files changed for three checkpoint intervals and a minute
    missing
};

struct PartStatus {
    std::string name;
    PartState state = PartState::missing;
    double fraction = 0.0;         // by the newest checkpoint; 1 where it is done
    double secondsSinceSign = 0.0; // seconds since its newest file was written, where it runs or stopped
    std::string host;              // that runs or ran it
};

struct SplitStatus {
    std::string folder;
    std::vector<PartStatus> parts; // in the order of their numbers
    std::optional<double>
        secondsLeft; // with as many parts at once as now; none: nothing runs, or nothing is known yet
    [[nodiscard]] size_t count(PartState state) const;
};

// Throws Error for a folder that `lavalight split` has not written.
[[nodiscard]] SplitStatus statusOf(const std::filesystem::path& folder);

[[nodiscard]] std::string textOf(const SplitStatus& status);
[[nodiscard]] std::string jsonOf(const SplitStatus& status);

} // namespace lavalight
