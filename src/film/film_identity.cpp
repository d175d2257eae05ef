#include "film/film_identity.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "film/film_file.h"
#include "film/film_machines.h"

namespace lavalight {
namespace {

constexpr std::string_view kOption = "option:";
constexpr std::string_view kContent = "content:";
constexpr std::string_view kCommitKey = "commit";
constexpr std::string_view kNoValue = "none";

// Options that choose samples or pixels, or say when to stop.
constexpr std::array<std::string_view, 6> kFreeOptions{"spp",          "first-sample", "time",
                                                       "target-error", "wave-size",    "crop"};
// Options that say where something comes from: its content is what counts.
constexpr std::array<std::string_view, 16> kSources{
    "env",      "look-from", "look-at", "up",      "fov", "intrinsics", "aperture", "focus",
    "panorama", "clip",      "no-clip", "shaders", "at",  "animation",  "scene",    "variant"};

template <size_t N>
bool isOneOf(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

enum class Weight { none, source, decisive };

Weight weightOf(std::string_view key, const std::vector<std::string>& alsoDecisive) {
    if (key.starts_with(kContent) || key == "version" || key == kCommitKey || key == kMachines ||
        isOneOf(kMachineKeys, key))
        return Weight::decisive;
    if (key == "scene" || key == "camera")
        return Weight::source;
    if (!key.starts_with(kOption))
        return Weight::none;
    const std::string_view option = key.substr(kOption.size());
    if (std::find(alsoDecisive.begin(), alsoDecisive.end(), option) != alsoDecisive.end())
        return Weight::decisive;
    if (isOneOf(kFreeOptions, option))
        return Weight::none;
    return isOneOf(kSources, option) ? Weight::source : Weight::decisive;
}

// Builds without git, and films of before, do not say a commit; their version speaks for them. Films of
// before do not say a processor either; their device speaks for it.
bool isUnknown(std::string_view key, const std::string& a, const std::string& b) {
    return (key == kCommitKey || key == "processor") && (a.empty() || b.empty());
}

bool isOfMachine(std::string_view key) {
    return key == kMachines || isOneOf(kMachineKeys, key);
}

std::string labelOf(std::string_view key) {
    if (key.starts_with(kOption))
        return fmt::format("--{}", key.substr(kOption.size()));
    return std::string(key.starts_with(kContent) ? key.substr(kContent.size()) : key);
}

// Hashes are told apart by their first digits; the accelerator's is a name.
std::string shown(std::string_view key, const std::string& value) {
    if (value.empty())
        return std::string(kNoValue);
    const bool isHash = key.starts_with(kContent) && labelOf(key) != "accelerator";
    return isHash ? fmt::format("content {}", value.substr(0, 8)) : value;
}

} // namespace

std::string differences(const FilmHeader& a, const FilmHeader& b,
                        const std::vector<std::string>& alsoDecisive, Machines machines) {
    std::set<std::string> keys;
    for (const Metadata* metadata : {&a.metadata, &b.metadata})
        for (const auto& pair : *metadata)
            keys.insert(pair.first);
    std::string text;
    bool isDecided = false;
    for (const std::string& key : keys) {
        const std::string ofA = valueOf(a.metadata, key);
        const std::string ofB = valueOf(b.metadata, key);
        const Weight weight = weightOf(key, alsoDecisive);
        if (ofA == ofB || weight == Weight::none || isUnknown(key, ofA, ofB) ||
            (machines == Machines::any && isOfMachine(key)))
            continue;
        isDecided = isDecided || weight == Weight::decisive;
        text += fmt::format("{}{} ({} in {}, {} in {})", text.empty() ? "" : ", ", labelOf(key),
                            shown(key, ofA), a.name, shown(key, ofB), b.name);
    }
    return isDecided ? text : std::string();
}

} // namespace lavalight
