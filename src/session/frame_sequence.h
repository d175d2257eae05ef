// The frames of an animation: which, at what times, and into which files.
#pragma once

#include <cstdint>
#include <string>

namespace lavalight {

// Frames from `first` to before `end`; frame i shows the moment i / framesPerSecond.
struct FrameRange {
    uint32_t first = 0;
    uint32_t end = 0;
    double framesPerSecond = 24.0;

    [[nodiscard]] double secondsOf(uint32_t frame) const { return frame / framesPerSecond; }
};

// The file of one frame: out_0007.exr for out.exr. An empty name stays empty.
[[nodiscard]] std::string numberedFile(const std::string& file, uint32_t frame);

} // namespace lavalight
