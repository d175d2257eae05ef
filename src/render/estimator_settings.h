// What the estimator does: every setting of it, with its default.
#pragma once

#include <cstdint>
#include <limits>

#include "light/lights.h"
#include "shared/frame.h"

namespace lavalight {

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
    cbrtThroughput = kRouletteCbrtThroughput,
};
enum class Fresnel : uint32_t { exact = kFresnelExact, schlick = kFresnelSchlick };
enum class TextureFilter : uint32_t {
    bilinear = kTextureFilterBilinear,
    stochastic = kTextureFilterStochastic
};

enum class PixelFilter : uint32_t { box, tent, gaussian, blackmanHarris, mitchell, point };

// Two renders of one scene with equal EstimatorSettings have equal bits.
struct EstimatorSettings {
    Sampler sampler = Sampler::sobol;
    Hemisphere hemisphere = Hemisphere::cosine; // how diffuse lobes draw directions
    bool nextEventEstimation = true;            // off: light is found only by hitting it
    LightSelection lightSelection = LightSelection::automatic;
    Mis mis = Mis::power; // off, with NEE on: emission found by BSDF rays counts at camera and delta vertices
    Roulette roulette = Roulette::cbrtThroughput;
    uint32_t rouletteStart = 3;       // first vertex where a path may die; the camera's first hit is vertex 1
    float rouletteProbability = 0.5f; // probability of survival, for Roulette::constant
    bool misSurvival = false; // the BSDF pdf of MIS weights is multiplied by the probability of survival
    Fresnel fresnel = Fresnel::exact; // reflectance of glass; opaque layers use Schlick's as glTF prescribes
    bool multipleScattering = false;  // rough metal returns what its facets send on to each other
    TextureFilter textureFilter =
        TextureFilter::bilinear;  // stochastic: one texel of four, shaded and then averaged
    bool smoothTerminator = true; // smooth-shaded meshes are lit as the smooth surface that normals stand for
    uint32_t maxBounces = 64;     // scattering vertices; 0 shows emission only
    float clampIndirect =
        std::numeric_limits<float>::infinity(); // biased: largest channel of an indirect contribution
    PixelFilter pixelFilter = PixelFilter::box;
    float filterRadius = std::numeric_limits<float>::infinity(); // pixels; infinite: the filter's own
    uint32_t seed = 0;
    bool operator==(const EstimatorSettings&) const = default;
};

} // namespace lavalight
