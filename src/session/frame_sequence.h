// The frames of an animation: which, at what times, and into which files.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

namespace lavalight {

// Frames from `first` to before `end`.
struct FrameRange {
    uint32_t first = 0;
    uint32_t end = 0;
};

// Declares --frames and --fps. Must outlive the parsing; the parser points into it.
class FrameSequence {
  public:
    explicit FrameSequence(CLI::App& parser);
    FrameSequence(const FrameSequence&) = delete;
    FrameSequence& operator=(const FrameSequence&) = delete;

    // Whether --frames was given. Throws UsageError for --fps without it.
    [[nodiscard]] bool isAsked() const;
    // Throws UsageError for a range or rate that is none.
    [[nodiscard]] FrameRange range() const;
    [[nodiscard]] double secondsOf(uint32_t frame) const { return frame / framesPerSecond_; }

  private:
    CLI::App* parser_; // asked which options were given
    std::string frames_;
    double framesPerSecond_ = 24.0;
};

// The file of one frame: out_0007.exr for out.exr. An empty name stays empty.
[[nodiscard]] std::string numberedFile(const std::string& file, uint32_t frame);

} // namespace lavalight
