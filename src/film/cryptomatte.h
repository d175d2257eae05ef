// Cryptomatte: which objects and materials a pixel shows and how much of it, in channels that compositing
// programs read. Source: Friedman, Jones, "Fully Automatic ID Mattes with Support for Motion Blur and
// Transparency", 2015; Cryptomatte Specification 1.2.0.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "film/id_counts.h"
#include "image/exr.h"

namespace lavalight {

// How the names of its attributes begin.
inline constexpr std::string_view kCryptomatteAttribute = "cryptomatte/";

// MurmurHash3_x86_32 (Austin Appleby) with the seed 0.
[[nodiscard]] uint32_t murmurHash3(std::string_view text);
// The id of a name: its hash as a float that is a normal number.
[[nodiscard]] float cryptomatteId(std::string_view name);

// A matte and what its file says of it.
struct Cryptomatte {
    std::vector<OwnedChannel<float>>
        channels;        // "CryptoObject00.R" to as many as the deepest pixel needs, 12 at least
    Metadata attributes; // the names of attributes in the file, and values
};
// `names[i]` is that of id i + 1; equal ones are told apart by a number. `samples`: of each pixel.
[[nodiscard]] Cryptomatte makeCryptomatte(const std::string& layer, const IdCounts& counts,
                                          const std::vector<std::string>& names,
                                          const std::vector<uint32_t>& samples);

// The names with " #2" and so on behind those that came before.
[[nodiscard]] std::vector<std::string> uniqueNames(const std::vector<std::string>& names);

} // namespace lavalight
