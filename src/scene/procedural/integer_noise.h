// Random numbers of procedural scenes: the same on every machine.
#pragma once

#include <cstdint>

namespace lavalight {

// Based on: Wellons, "Prospecting for Hash Functions", 2018 (the constants of lowbias32).
[[nodiscard]] inline uint32_t hash(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

// A number uniform in [0, 1), a function of its three keys.
[[nodiscard]] inline float random(uint32_t a, uint32_t b, uint32_t c = 0) {
    return static_cast<float>(hash(a + hash(b + hash(c))) >> 8) * 0x1p-24f;
}

} // namespace lavalight
