#version 460
// Adds the finished paths of the wave to the film, one invocation a pixel, exactly.
#include "lib/fixed_point.glsl"
#include "scene/frame.glsl"
#include "scene/tally.glsl"
#include "scene/wave.glsl"
#include "shared/film.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_FILM, std430) buffer Film { uint film[]; };

bool isFinite(vec3 v) {
    return !any(isnan(v)) && !any(isinf(v));
}

// One channel of one pixel: its words stay in registers while the wave's samples are added.
void accumulateChannel(uint channel, uint pixel, uint firstSlot) {
    const uint n = frame.bandPixels;
    const uint at = channel * kChannelWords * n + pixel;
    uvec3 sum = uvec3(film[at], film[at + n], film[at + 2u * n]);
    uvec4 square = uvec4(film[at + 3u * n], film[at + 4u * n], film[at + 5u * n], film[at + 6u * n]);
    uint saturated = 0u;
    for (uint slot = firstSlot; slot < firstSlot + range.sampleCount; ++slot) {
        const vec3 radiance = paths[slot].radiance;
        if (!isFinite(radiance))
            continue;
        const float value = max(radiance[channel], 0.0);
        saturated += addExactly(sum, value, kSumLowestExponent) ? 0u : 1u;
        saturated += addExactly(square, value * value, kSquareLowestExponent) ? 0u : 1u;
    }
    if (saturated > 0u)
        addTally(kTallySaturated, saturated);
    film[at] = sum.x;
    film[at + n] = sum.y;
    film[at + 2u * n] = sum.z;
    film[at + 3u * n] = square.x;
    film[at + 4u * n] = square.y;
    film[at + 5u * n] = square.z;
    film[at + 6u * n] = square.w;
}

// The sample count, and what the ledger wants to know.
void accumulateCounts(uint pixel, uint firstSlot) {
    uint dropped = 0u;
    for (uint slot = firstSlot; slot < firstSlot + range.sampleCount; ++slot)
        dropped += isFinite(paths[slot].radiance) ? 0u : 1u;
    if (dropped > 0u)
        addTally(kTallyDropped, dropped);
    film[kCountPlane * frame.bandPixels + pixel] += range.sampleCount - dropped;
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= range.pixelCount)
        return;
    const uint pixel = range.firstPixel - range.bandFirstPixel + index;
    const uint firstSlot = index * range.sampleCount;
    for (uint channel = 0u; channel < 3u; ++channel)
        accumulateChannel(channel, pixel, firstSlot);
    accumulateCounts(pixel, firstSlot);
}
