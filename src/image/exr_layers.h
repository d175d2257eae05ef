// Which channels of an OpenEXR file make which layer, whoever wrote it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "image/rendering.h"

namespace lavalight {

struct ExrChannel {
    std::string name;
    bool isFloat = true;      // a number of 16 or 32 bits, rather than an integer
    bool hasAllPixels = true; // rather than every other
};

inline constexpr const char* kLuminance = "Y";
inline constexpr size_t kMostComponents = 3; // components of a layer, at most

// The channels that hold the variance of others.
[[nodiscard]] std::vector<std::string> varianceChannels(const std::vector<std::string>& channels);

// The layer of radiance, without pixels: R, G, B, or Y alone. Throws Error, naming the channels that there
// are, where there is none.
[[nodiscard]] Layer colorLayerIn(std::span<const ExrChannel> channels);

// The layer of radiance, then the others by their names, without pixels; those that have variances have empty
// ones. `channels` are in alphabetical order. Throws Error as above.
[[nodiscard]] std::vector<Layer> layersIn(std::span<const ExrChannel> channels);

} // namespace lavalight
