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
    parser
        .add_option("--frame", frame_,
                    "Render frame N of the animation, or of --turntable, alone, into the file as it is named")
        ->type_name("N")
        ->default_str("");
    parser.add_option("--fps", framesPerSecond_, "Frames a second of --frames and --frame")->type_name("N");
}

bool FrameOptions::isAsked() const {
    const bool isSingle = parser_->count("--frame") > 0;
    if (parser_->count("--fps") > 0 && frames_.empty() && (!isSingle || isTurntable()))
        throw UsageError("--fps: needs --frames A:B or --frame N of an animation");
    if (isSingle && !frames_.empty())
        throw UsageError(
            "--frame and --frames: one is a frame alone, the other several; give one of the two");
    if (isTurntable() && !frames_.empty())
        throw UsageError("--turntable and --frames: both make several images; give one of the two");
    return !isSingle && (isTurntable() || !frames_.empty());
}

std::optional<uint32_t> FrameOptions::single() const {
    if (parser_->count("--frame") == 0)
        return std::nullopt;
    const uint32_t end = isTurntable() ? turntable_ : kMostFrames;
    if (frame_ >= end)
        throw UsageError(fmt::format("--frame: {} is not a frame below {}", frame_, end));
    return frame_;
}

std::optional<float> FrameOptions::turnsOf(uint32_t frame) const {
    return isTurntable() ? std::optional(static_cast<float>(frame) / static_cast<float>(turntable_))
                         : std::nullopt;
}

void FrameOptions::requireRate() const {
    if (!(framesPerSecond_ > 0.0) || !std::isfinite(framesPerSecond_))
        throw UsageError(fmt::format("--fps: {} is not a rate above 0", framesPerSecond_));
}

FrameRange FrameOptions::range() const {
    requireRate();
    if (isTurntable())
        return {0, turntable_, framesPerSecond_};
    if (frames_.empty())
        return {frame_, frame_ + 1, framesPerSecond_};
    const auto parts = splitAt(frames_, ':');
    const auto first = parseNumber<uint32_t>(parts.front());
    const auto end = parseNumber<uint32_t>(parts.back());
    if (parts.size() != 2 || !first || !end || *first >= *end || *end > kMostFrames)
        throw UsageError(
            fmt::format("--frames: \"{}\" is not A:B with A below B and B up to {}", frames_, kMostFrames));
    return {*first, *end, framesPerSecond_};
}

} // namespace lavalight
