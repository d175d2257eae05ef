#include "split/split_plan.h"

#include <cctype>

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr uint64_t kMostParts = 1'000'000;
constexpr uint32_t kMostPartsOfFrame = 10'000; // their names stand on one command line
constexpr uint64_t kMostMatrixJobs = 256;      // GitHub's limit for a matrix

// Where the samples of part `i` begin; those of the last end where part `parts` would begin.
uint32_t firstSampleOf(const SplitPlan& plan, uint32_t i) {
    const uint64_t count = plan.samples.end - plan.samples.first;
    return plan.samples.first + static_cast<uint32_t>(count * i / plan.parts);
}

} // namespace

std::vector<SplitPart> partsOf(const SplitPlan& plan) {
    std::vector<SplitPart> parts;
    const SplitFrames frames = plan.frames.value_or(SplitFrames{0, 1});
    for (uint32_t frame = frames.first; frame < frames.end; ++frame)
        for (uint32_t i = 0; i < plan.parts; ++i) {
            SplitPart part;
            part.name = fmt::format("part-{:04}", i);
            if (plan.frames) {
                part.name = fmt::format("frame-{:04}-{}", frame, part.name);
                part.words = {"--frame", fmt::format("{}", frame)};
                part.frame = frame;
            }
            part.words.insert(part.words.end(), {"--samples", fmt::format("{}:{}", firstSampleOf(plan, i),
                                                                          firstSampleOf(plan, i + 1))});
            parts.push_back(std::move(part));
        }
    return parts;
}

void requirePossible(const SplitPlan& plan) {
    const uint64_t samples = plan.samples.end - plan.samples.first;
    if (plan.parts < 1 || plan.parts > samples)
        throw UsageError(fmt::format("--parts: {} parts cannot share {} samples; give 1 to {}, or more --spp",
                                     plan.parts, samples, samples));
    if (plan.parts > kMostPartsOfFrame)
        throw UsageError(
            fmt::format("--parts: {} parts are more than {}; give fewer", plan.parts, kMostPartsOfFrame));
    const uint64_t frames = plan.frames ? plan.frames->end - plan.frames->first : 1;
    const uint64_t parts = plan.parts * frames;
    if (parts > kMostParts)
        throw UsageError(fmt::format("--parts: {} parts for each of {} frames are more than {}; give fewer",
                                     plan.parts, frames, kMostParts));
    if (plan.engine == SplitEngine::github && parts > kMostMatrixJobs)
        throw UsageError(fmt::format(
            "--parts: {} parts for each of {} frames are more than the {} jobs of a matrix; give fewer",
            plan.parts, frames, kMostMatrixJobs));
}

std::string shellQuoted(const std::string& word) {
    const auto isPlain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("-_./:,=+@%").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain))
        return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

} // namespace lavalight
