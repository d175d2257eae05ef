// Equirectangular environment maps from files.
#pragma once

#include <cstdint>
#include <filesystem>

#include "image/image.h"

namespace lavalight {

struct EnvironmentFile {
    Image image;
    uint64_t badTexels = 0; // had negative, infinite or undefined values, which are 0 now
};

// Whether the path ends as those files do: .hdr, .pic or .exr, in either case.
[[nodiscard]] bool hasEnvironmentExtension(const std::filesystem::path& path);

// Reads .exr (image/exr.h) or .hdr (image/hdr.h), told apart by their first bytes. Throws Error for whatever
// is no such file, and for maps of more than 2^27 texels.
[[nodiscard]] EnvironmentFile readEnvironmentFile(const std::filesystem::path& path);

} // namespace lavalight
