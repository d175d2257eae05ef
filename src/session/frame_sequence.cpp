#include "session/frame_sequence.h"

#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr uint32_t kMostFrames = 1'000'000; // frame numbers: four digits or more

bool parseAll(std::string_view text, uint32_t& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace

FrameSequence::FrameSequence(CLI::App& parser) : parser_(&parser) {
    parser
        .add_option("--frames", frames_,
                    "Render the animation's frames A to before B, at A/fps seconds and on, into numbered "
                    "files: OUT_0007.exr")
        ->type_name("A:B");
    parser.add_option("--fps", framesPerSecond_, "Frames a second of --frames")->type_name("N");
}

bool FrameSequence::isAsked() const {
    if (parser_->count("--fps") > 0 && frames_.empty())
        throw UsageError("--fps: needs --frames A:B");
    return !frames_.empty();
}

FrameRange FrameSequence::range() const {
    const std::string_view text = frames_;
    const size_t colon = text.find(':');
    FrameRange range;
    const bool isRange = colon != std::string_view::npos && parseAll(text.substr(0, colon), range.first) &&
                         parseAll(text.substr(colon + 1), range.end);
    if (!isRange || range.first >= range.end || range.end > kMostFrames)
        throw UsageError(
            fmt::format("--frames: \"{}\" is not A:B with A below B and B up to {}", frames_, kMostFrames));
    if (!(framesPerSecond_ > 0.0) || !std::isfinite(framesPerSecond_))
        throw UsageError(fmt::format("--fps: {} is no rate above 0", framesPerSecond_));
    return range;
}

std::string numberedFile(const std::string& file, uint32_t frame) {
    if (file.empty())
        return file;
    const std::filesystem::path path(file);
    const std::string name =
        fmt::format("{}_{:04}{}", path.stem().string(), frame, path.extension().string());
    return (path.parent_path() / name).string();
}

} // namespace lavalight
