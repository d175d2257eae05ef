// The options that make a sequence of frames of a render.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "session/frame_sequence.h"

namespace lavalight {

// Declares --frames, --frame, --fps and --turntable. Must outlive the parsing; the parser points into it.
class FrameOptions {
  public:
    explicit FrameOptions(CLI::App& parser);
    FrameOptions(const FrameOptions&) = delete;
    FrameOptions& operator=(const FrameOptions&) = delete;

    // Whether there are several images. Throws UsageError for options that contradict each other.
    [[nodiscard]] bool isAsked() const;
    // The one frame of --frame. Throws UsageError where the sequence has no such frame.
    [[nodiscard]] std::optional<uint32_t> single() const;
    // Throws UsageError for a range or a rate that makes no sense.
    [[nodiscard]] FrameRange range() const;
    // The turns of a turntable's frame; none: the frames are moments of an animation.
    [[nodiscard]] std::optional<float> turnsOf(uint32_t frame) const;
    [[nodiscard]] bool isTurntable() const { return turntable_ > 0; }

  private:
    void requireRate() const;

    CLI::App* parser_; // asked which options were given
    std::string frames_;
    uint32_t frame_ = 0;
    uint32_t turntable_ = 0; // frames; 0: none
    double framesPerSecond_ = FrameRange().framesPerSecond;
};

} // namespace lavalight
