#version 460
// Adds the finished paths of the wave to the film, one invocation a pixel, exactly.
#include "lib/fixed_point.glsl"
#include "scene/frame.glsl"
#include "scene/wave.glsl"
#include "shared/film.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_FILM, std430) buffer Film { uint film[]; };
layout(set = 0, binding = BINDING_TALLIES, std430) buffer Tallies { uint tallies[]; };

// Adds to a 64-bit count in two words.
void addTally(uint which, uint amount) {
    const uint before = atomicAdd(tallies[2u * which], amount);
    if (before + amount < before)
        atomicAdd(tallies[2u * which + 1u], 1u);
}

// Adds `value` to the sum whose lowest word is in plane `plane`; what leaves the range saturates and is counted.
void addExactly(float value, uint plane, uint words, int lowestExponent, uint pixel) {
    const Shifted s = toFixed(value, lowestExponent, words);
    uint carry = 0u;
    for (uint i = 0u; i < words; ++i) {
        const uint at = (plane + i) * frame.bandPixels + pixel;
        film[at] = addWithCarry(film[at], wordOf(s, i), carry);
    }
    if (carry == 0u && !s.overflows)
        return;
    for (uint i = 0u; i < words; ++i)
        film[(plane + i) * frame.bandPixels + pixel] = 0xffffffffu;
    addTally(kTallySaturated, 1u);
}

void addSample(vec3 radiance, uint pixel) {
    for (uint channel = 0u; channel < 3u; ++channel) {
        const float value = max(radiance[channel], 0.0);
        const uint plane = channel * kChannelWords;
        addExactly(value, plane, kSumWords, kSumLowestExponent, pixel);
        addExactly(value * value, plane + kSumWords, kSquareWords, kSquareLowestExponent, pixel);
    }
    film[kCountPlane * frame.bandPixels + pixel] += 1u;
}

void main() {
    if (gl_GlobalInvocationID.x >= range.pixelCount)
        return;
    const uint pixel = range.firstPixel - range.bandFirstPixel + gl_GlobalInvocationID.x;
    for (uint i = 0u; i < range.sampleCount; ++i) {
        const Path path = paths[i * range.pixelCount + gl_GlobalInvocationID.x];
        if (any(isnan(path.radiance)) || any(isinf(path.radiance)))
            addTally(kTallyDropped, 1u);
        else
            addSample(path.radiance, pixel);
        if (path.isCut != 0u) {
            addTally(kTallyCutPaths, 1u);
            addTally(kTallyCutThroughput,
                     uint(min(dot(path.throughput, vec3(1.0 / 3.0)), 65535.0) * 65536.0 + 0.5));
        }
    }
}
