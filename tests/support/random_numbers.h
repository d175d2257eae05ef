// Seeded random numbers for tests, the same on every platform: the standard leaves its distributions open.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <glm/glm.hpp>

namespace lavalight::test {

class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}

    [[nodiscard]] uint32_t bits() { return engine_(); }
    // A number in [0, 1), a multiple of 2^-24.
    [[nodiscard]] float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    [[nodiscard]] float between(float low, float high) { return low + (high - low) * unit(); }
    // A direction, uniform on the unit sphere.
    [[nodiscard]] glm::vec3 direction() {
        const float z = between(-1.0f, 1.0f);
        const float phi = 2.0f * std::numbers::pi_v<float> * unit();
        const float r = std::sqrt(std::fmax(0.0f, 1.0f - z * z));
        return glm::normalize(glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
    }

  private:
    std::mt19937 engine_;
};

} // namespace lavalight::test
