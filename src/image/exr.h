// OpenEXR files: our renderings out, anybody's images in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"
#include "image/pixel_limit.h"
#include "image/rendering.h"

namespace lavalight {

// Key and value; keys are non-empty and unique.
using Metadata = std::vector<std::pair<std::string, std::string>>;

// A channel of 32-bit unsigned numbers, row by row from the top.
struct UintChannel {
    std::string name;
    std::span<const uint32_t> values;
};

// A channel with values of its own, row by row from the top.
template <typename Value>
struct OwnedChannel {
    std::string name;
    std::vector<Value> values;
};

// What an EXR file holds beside a rendering.
struct ExrContents {
    std::vector<UintChannel> words;
    std::vector<OwnedChannel<uint32_t>> uints;
    std::vector<OwnedChannel<float>> floats;
    Metadata attributes; // by their full names
};

inline constexpr const char* kSampleChannel = "samples";

// Writes a scan-line file with ZIP compression, all or nothing (base/file.h). Channels:
//   R G B                              32-bit float, linear Rec. 709
//   variance.R variance.G variance.B   32-bit float, the variance of each pixel's mean
//   samples                            32-bit unsigned, how many samples each pixel rests on
// and so, by their own names, those of further layers, each with its variance if it has one; and `more`. The
// display window is the whole that the rendering is a part of, the data window its own pixels.
// Metadata become string attributes named "lavalight:<key>". Equal input gives equal bytes. Throws Error.
void writeExr(const std::filesystem::path& path, const Rendering& rendering, const Metadata& metadata,
              const ExrContents& more = {});

// The data window, wherever it lies; its place if it is another than the display window and within it.
// Without variance and sample counts where the file lacks them.
struct ExrFile : Rendering {
    Metadata metadata; // string attributes by name, "lavalight:" taken off, in alphabetical order of the full
                       // names
};

// Reads the first part of any scan-line or tiled file with R, G and B, or with luminance Y alone, in half,
// float or unsigned. Further layers are one to three float or half channels that share a name up to its last
// dot, as R, G, B or in alphabetical order, beside its A as a layer of that name, or one channel without a
// dot; other channels, and cryptomattes, are ignored. Colours are taken as linear Rec. 709; a file that says
// otherwise gets a warning. Throws Error for whatever is no such file: missing, damaged, incomplete, larger
// than kMaxImageSide a side or than memory, without colour.
[[nodiscard]] ExrFile readExr(const std::filesystem::path& path);

// Reads the radiance alone, as an equirectangular map of all directions (image/exr_sphere.h). Throws Error
// for more than `mostPixels` as well.
[[nodiscard]] Image readExrEnvironment(const std::filesystem::path& path, uint64_t mostPixels);

// What a file says of itself: the size of its data window, and metadata as ExrFile's. No pixel is read.
// Throws Error as readExr does.
struct ExrHeader {
    uint32_t width = 0;
    uint32_t height = 0;
    Metadata metadata;
};
[[nodiscard]] ExrHeader readExrHeader(const std::filesystem::path& path);

struct UintImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> values; // all of the first channel, then all of the second, and so on
    Metadata metadata;            // as ExrFile's
};

// The channels alone that `namesIn` picks by the file's metadata; nothing unless the file has them all, as
// 32-bit unsigned numbers. Throws Error as readExr does, and what `namesIn` throws, with the file's name.
using ChannelNames = std::function<std::vector<std::string>(const Metadata& metadata)>;
[[nodiscard]] std::optional<UintImage> readUintChannels(const std::filesystem::path& path,
                                                        const ChannelNames& namesIn);

} // namespace lavalight
