// What a render is asked to do: every estimator setting with its default and what it means.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "image/image.h"
#include "shared/frame.h"

namespace lavalight {

// Values are those of the specialisation constants in shaders/shared/frame.h.
enum class Mis : uint32_t { power = kMisPower, balance = kMisBalance, off = kMisOff };
enum class Roulette : uint32_t { throughput = kRouletteThroughput, off = kRouletteOff };

// What the estimator does. Two renders of one scene with equal EstimatorSettings have equal bits.
struct EstimatorSettings {
    bool nextEventEstimation = true; // off: light is found only by hitting it
    Mis mis = Mis::power;            // off, with NEE on: emission found by BSDF rays counts at camera and delta vertices
    Roulette roulette = Roulette::throughput;
    uint32_t rouletteStart = 3; // first vertex where a path may die; the camera's first hit is vertex 1
    uint32_t maxBounces = 64;   // scattering vertices; 0 shows emission only
    uint32_t seed = 0;
};

// What is rendered, and how the work is cut up. The cutting changes no bit of the image.
struct RenderSettings {
    EstimatorSettings estimator;
    uint32_t width = 0; // pixels; 0: by the camera's aspect ratio from the height
    uint32_t height = 512;
    uint32_t samples = 64;       // per pixel
    uint32_t firstSample = 0;    // samples [firstSample, firstSample + samples)
    uint32_t waveSize = 65536;   // path slots of a wave
    uint32_t bandRows = 0;       // rows of a film band; 0: as many as a storage buffer of the device holds
    std::optional<glm::vec3> environment; // constant radiance that replaces the scene's
};

constexpr uint32_t kMaxBounceLimit = 1024; // counters of every bounce are kept for the whole wave

// Throws UsageError naming the option and its range.
void checkSettings(const RenderSettings& settings);

[[nodiscard]] std::string_view nameOf(Mis value);
[[nodiscard]] std::string_view nameOf(Roulette value);

// Option name (without dashes) and value of everything that decides the image's bits, for the EXR header and report.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> describe(const RenderSettings& settings);

} // namespace lavalight
