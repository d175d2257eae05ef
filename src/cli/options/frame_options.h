// The options that make a sequence of frames of a render.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "session/frame_sequence.h"

namespace lavalight {

// Declares --frames and --fps. Must outlive the parsing; the parser points into it.
class FrameOptions {
  public:
    explicit FrameOptions(CLI::App& parser);
    FrameOptions(const FrameOptions&) = delete;
    FrameOptions& operator=(const FrameOptions&) = delete;

    // Whether --frames was given. Throws UsageError for --fps without it.
    [[nodiscard]] bool isAsked() const;
    // Throws UsageError for a range or a rate that makes no sense.
    [[nodiscard]] FrameRange range() const;

  private:
    CLI::App* parser_; // asked which options were given
    std::string frames_;
    double framesPerSecond_ = FrameRange().framesPerSecond;
};

} // namespace lavalight
