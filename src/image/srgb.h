// sRGB signals and the linear values that they stand for (IEC 61966-2-1:1999).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace lavalight {

// The linear value in [0, 1] of a signal in [0, 1].
[[nodiscard]] inline double decodeSrgb(double signal) {
    return signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4);
}

// The linear colour of signals 0xrrggbb.
[[nodiscard]] inline glm::vec3 decodeSrgb8(uint32_t signals) {
    const auto channel = [&](uint32_t shift) {
        return static_cast<float>(decodeSrgb((signals >> shift & 0xffu) / 255.0));
    };
    return {channel(16), channel(8), channel(0)};
}

// The nearest of 256 signals; what lies outside [0, 1] is clamped, NaN is black.
[[nodiscard]] inline uint32_t encodeSrgb8(float linear) {
    const float x = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
    const float signal = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): the signal is not negative.
    return static_cast<uint32_t>(255.0f * signal + 0.5f);
}

} // namespace lavalight
