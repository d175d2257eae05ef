#include "cli/options/frame_options.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/options/option_values.h"

namespace lavalight {
namespace {

constexpr uint32_t kMostFrames = 1'000'000; // frame numbers have four digits or more

} // namespace

FrameOptions::FrameOptions(CLI::App& parser) : parser_(&parser) {
    parser
        .add_option("--frames", frames_,
                    "Render the animation's frames A to before B, at A/fps seconds and on, into numbered "
                    "files: OUT_0007.exr")
        ->type_name("A:B");
    parser
        .add_option("--turntable", turntable_,
                    "Render N images of one turn around the scene into numbered files; --view says from how "
                    "high")
        ->type_name("N")
        ->check(CLI::Range(1u, kMostFrames))
        ->default_str("");
    parser.add_option("--fps", framesPerSecond_, "Frames a second of --frames")->type_name("N");
}

bool FrameOptions::isAsked() const {
    if (parser_->count("--fps") > 0 && frames_.empty())
        throw UsageError("--fps: needs --frames A:B");
    if (isTurntable() && !frames_.empty())
        throw UsageError("--turntable and --frames: both make several images; give one of the two");
    return isTurntable() || !frames_.empty();
}

std::optional<float> FrameOptions::turnsOf(uint32_t frame) const {
    return isTurntable() ? std::optional(static_cast<float>(frame) / static_cast<float>(turntable_))
                         : std::nullopt;
}

FrameRange FrameOptions::range() const {
    if (isTurntable())
        return {0, turntable_, framesPerSecond_};
    const auto parts = splitAt(frames_, ':');
    const auto first = parseNumber<uint32_t>(parts.front());
    const auto end = parseNumber<uint32_t>(parts.back());
    if (parts.size() != 2 || !first || !end || *first >= *end || *end > kMostFrames)
        throw UsageError(
            fmt::format("--frames: \"{}\" is not A:B with A below B and B up to {}", frames_, kMostFrames));
    if (!(framesPerSecond_ > 0.0) || !std::isfinite(framesPerSecond_))
        throw UsageError(fmt::format("--fps: {} is not a rate above 0", framesPerSecond_));
    return {*first, *end, framesPerSecond_};
}

} // namespace lavalight
