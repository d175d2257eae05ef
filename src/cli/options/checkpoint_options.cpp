#include "cli/options/checkpoint_options.h"

#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {

CheckpointOptions::CheckpointOptions(CLI::App& parser) : parser_(&parser) {
    parser
        .add_option("--checkpoint", file_,
                    "EXR file that the render can be continued from, written now and then, at the end, and "
                    "when it is interrupted")
        ->type_name("FILE.exr");
    parser.add_option("--checkpoint-every", seconds_, "Seconds between two checkpoints")
        ->type_name("SECONDS");
    parser.add_flag("--resume", isResuming_,
                    "Go on from --checkpoint, to the same bits; where there is none yet, start");
}

std::string CheckpointOptions::file(const RenderSettings& settings) const {
    if (parser_->count("--checkpoint") == 0) {
        for (const char* option : {"--checkpoint-every", "--resume"})
            if (parser_->count(option) > 0)
                throw UsageError(fmt::format("{}: needs --checkpoint FILE", option));
        return {};
    }
    if (!(seconds_ >= 0.0 && seconds_ <= 1e9))
        throw UsageError(
            fmt::format("--checkpoint-every: {} is outside the range 0 to 1000000000", seconds_));
    if (settings.stop.seconds > 0.0)
        throw UsageError("--checkpoint and --time: what a time suffices for cannot be had a second time, bit "
                         "for bit; give one of the two (an interrupted render writes its checkpoint)");
    const bool isFrame = parser_->count("--frame") > 0;
    for (const char* option : {"--frames", "--turntable", "--watch"})
        if (parser_->count(option) > 0 && !(isFrame && option == std::string_view("--turntable")))
            throw UsageError(fmt::format("--checkpoint and {}: a checkpoint is of one image", option));
    std::error_code unknown;
    if (!isResuming_ && std::filesystem::is_regular_file(file_, unknown))
        throw Error(fmt::format("{} is there already: go on from it with --resume, or remove it", file_));
    return file_;
}

} // namespace lavalight
