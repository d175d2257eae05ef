// What a render is asked to do: every estimator setting with its default and what it means.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "image/image.h"
#include "light/lights.h"
#include "shared/frame.h"

namespace lavalight {

// Options of the command line: names without dashes, and values.
using OptionPairs = std::vector<std::pair<std::string, std::string>>;

// Values are those of the specialisation constants in shaders/shared/frame.h.
enum class Sampler : uint32_t { sobol = kSamplerSobol, independent = kSamplerIndependent };
enum class Hemisphere : uint32_t { cosine = kHemisphereCosine, uniform = kHemisphereUniform };
enum class Mis : uint32_t { power = kMisPower, balance = kMisBalance, off = kMisOff };
enum class Roulette : uint32_t {
    throughput = kRouletteThroughput,
    off = kRouletteOff,
    constant = kRouletteConstant,
    meanAlbedo = kRouletteMeanAlbedo,
    maxAlbedo = kRouletteMaxAlbedo,
    sqrtThroughput = kRouletteSqrtThroughput,
};
enum class Fresnel : uint32_t { exact = kFresnelExact, schlick = kFresnelSchlick };
enum class TextureFilter : uint32_t {
    bilinear = kTextureFilterBilinear,
    stochastic = kTextureFilterStochastic
};

// How kernels cut up the work of a path. Their code is the same; bits may differ where a driver rounds
// otherwise.
enum class Kernels {
    automatic, // by the kind of device
    fused,     // one kernel for whole paths
    wavefront  // a kernel for each step of a bounce
};

// What the estimator does. Two renders of one scene with equal EstimatorSettings have equal bits.
struct EstimatorSettings {
    Sampler sampler = Sampler::sobol;
    Hemisphere hemisphere = Hemisphere::cosine; // how diffuse lobes draw directions
    bool nextEventEstimation = true;            // off: light is found only by hitting it
    LightSelection lightSelection = LightSelection::automatic;
    Mis mis = Mis::power; // off, with NEE on: emission found by BSDF rays counts at camera and delta vertices
    Roulette roulette = Roulette::sqrtThroughput;
    uint32_t rouletteStart = 3;       // first vertex where a path may die; the camera's first hit is vertex 1
    float rouletteProbability = 0.5f; // of survival, for Roulette::constant
    bool misSurvival = false; // the BSDF pdf of MIS weights is multiplied by the probability of survival
    Fresnel fresnel = Fresnel::exact; // of glass; opaque layers use Schlick's as glTF prescribes
    bool multipleScattering = false;  // rough metal returns what its facets send on to each other
    TextureFilter textureFilter =
        TextureFilter::bilinear; // stochastic: one texel of four, shaded and then averaged
    uint32_t maxBounces = 64;    // scattering vertices; 0 shows emission only
    float clampIndirect =
        std::numeric_limits<float>::infinity(); // biased: largest channel of an indirect contribution
    uint32_t seed = 0;
    bool operator==(const EstimatorSettings&) const = default;
};

// What is rendered, when to stop, and how the work is cut up. The cutting changes no bit of the image.
struct RenderSettings {
    EstimatorSettings estimator;
    uint32_t width = 0; // pixels; 0: by the camera's aspect ratio from the height
    uint32_t height = 512;
    uint32_t samples = 64;      // per pixel, at most
    uint32_t firstSample = 0;   // samples [firstSample, firstSample + samples)
    double seconds = 0.0;       // stop after this time; 0: no limit
    double targetError = 0.0;   // stop when the estimated relMSE is below this; 0: no target
    bool isProgressive = false; // passes start with one sample, so that every pixel soon has some
    Kernels kernels = Kernels::automatic;
    uint32_t waveSize = 0; // path slots of a wave; 0: by the kernels
    uint32_t bandRows = 0; // rows of a film band; 0: as many as a storage buffer of the device holds
    std::optional<glm::vec3> environment; // constant radiance that replaces the scene's
    std::string environmentFile;          // where Scene::environmentMap came from; empty: nowhere
    float environmentRotation = 0.0f;     // of the map about +Y, degrees, counter-clockwise seen from above
    std::vector<std::string> changedShaders; // of --shaders, for the record
    OptionPairs cameraOptions;               // as given, for describe() alone
    float environmentIntensity = 1.0f;       // multiplies the environment, whatever it is
    bool operator==(const RenderSettings&) const = default;
};

constexpr uint32_t kMaxBounceLimit = 1024; // counters of every bounce are kept for the whole wave

// Throws UsageError naming the option and its range, or the options that contradict each other.
void checkSettings(const RenderSettings& settings);

// Option name (without dashes) and value of everything that decides the image's bits, for the EXR header and
// report.
[[nodiscard]] OptionPairs describe(const RenderSettings& settings);

} // namespace lavalight
