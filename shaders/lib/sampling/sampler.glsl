// Sample numbers as pure functions of their key: pixel, sample, vertex, named dimension, seed.
#include "lib/estimator.glsl"
#include "lib/sampling/random.glsl"
#include "lib/sampling/sobol.glsl"

// Named dimensions of a vertex, padded: each has a sequence of its own. New ones go to the end: the numbers are part of
// what a seed means. 2-D and 1-D ones must not share a number.
const uint kDimensionPixel = 0u;       // 2-D: position within the pixel (camera vertex)
const uint kDimensionLight = 1u;       // 2-D: which light, and a point or direction of it
const uint kDimensionBsdf = 3u;        // 2-D: direction
const uint kDimensionLobe = 4u;        // 1-D: which lobe
const uint kDimensionRoulette = 5u;    // 1-D: survival
const uint kDimensionChannel = 6u;     // 1-D: which colour a dispersing body refracts
const uint kDimensionLens = 7u;        // 2-D: point on the lens (camera vertex)
const uint kDimensionAlpha = 8u;       // 1-D, with each triangle: whether the ray from here passes through
const uint kDimensionShadowAlpha = 9u; // 1-D, with each triangle: whether the shadow ray passes through
const uint kDimensionTexel = 10u;      // 2-D: which of four texels, with --texture-filter stochastic

struct SampleKey {
    uint seed;
    uint pixel;  // row-major index in the image
    uint index;  // sample number of that pixel
    uint vertex; // 0 at the camera
};

// 32 random bits for each of two numbers.
uvec2 sampleBits2D(SampleKey key, uint dimension) {
    const uint place = key.vertex << 8u | dimension;
    if (kSampler == kSamplerIndependent)
        return pcg4d(uvec4(key.pixel, key.index, place, key.seed)).xy;
    // Burley's padding: the hash of everything but the index seeds shuffling and scrambling, decorrelating pixels too.
    return scrambledSobolPair(key.index, pcg4d(uvec4(key.pixel, 0x5eed5eedu, place, key.seed)).xyz);
}

uint sampleBits1D(SampleKey key, uint dimension) {
    const uint place = key.vertex << 8u | dimension;
    if (kSampler == kSamplerIndependent)
        return pcg4d(uvec4(key.pixel, key.index, place, key.seed)).x;
    const uvec2 seeds = pcg4d(uvec4(key.pixel, 0x5eed5eedu, place, key.seed)).xy;
    return scrambledVanDerCorput(shuffledIndex(key.index, seeds.x), seeds.y);
}

vec2 sample2D(SampleKey key, uint dimension) {
    return bitsToUnit(sampleBits2D(key, dimension));
}

float sample1D(SampleKey key, uint dimension) {
    return bitsToUnit(sampleBits1D(key, dimension));
}
