#version 460
// Adds the finished paths of the wave to the film, one invocation a pixel, exactly.
#include "lib/film/fixed_point.glsl"
#include "scene/frame.glsl"
#include "scene/tally.glsl"
#include "scene/wave.glsl"
#include "shared/film.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_FILM, std430) buffer Film { uint film[]; };

bool isFinite(vec3 v) {
    return !any(isnan(v)) && !any(isinf(v));
}

// The sums of one channel of one pixel: in registers while the wave's samples are added.
struct ChannelSums {
    uvec3 sum;
    uvec4 square;
};

uint wordAt(uint channel, uint word, uint pixel) {
    return (channel * kChannelWords + word) * frame.bandPixels + pixel;
}

ChannelSums loadSums(uint channel, uint pixel) {
    return ChannelSums(uvec3(film[wordAt(channel, 0u, pixel)], film[wordAt(channel, 1u, pixel)],
                             film[wordAt(channel, 2u, pixel)]),
                       uvec4(film[wordAt(channel, 3u, pixel)], film[wordAt(channel, 4u, pixel)], film[wordAt(channel, 5u, pixel)],
                             film[wordAt(channel, 6u, pixel)]));
}

void storeSums(uint channel, uint pixel, ChannelSums sums) {
    for (uint word = 0u; word < 3u; ++word)
        film[wordAt(channel, word, pixel)] = sums.sum[word];
    for (uint word = 0u; word < 4u; ++word)
        film[wordAt(channel, 3u + word, pixel)] = sums.square[word];
}

void addRadiance(inout ChannelSums sums, float radiance) {
    const float value = max(radiance, 0.0);
    addExactly(sums.sum, value, kSumLowestExponent);
    addExactly(sums.square, value * value, kSquareLowestExponent);
}

// Sums that have left their range. They are counted when they do, not once a sample: so the count follows from the film.
uint saturatedSums(ChannelSums sums) {
    return (sums.sum == uvec3(0xffffffffu) ? 1u : 0u) + (sums.square == uvec4(0xffffffffu) ? 1u : 0u);
}

uint saturatedSums(ChannelSums red, ChannelSums green, ChannelSums blue) {
    return saturatedSums(red) + saturatedSums(green) + saturatedSums(blue);
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= range.pixelCount)
        return;
    const uint pixel = range.firstPixel - range.bandFirstPixel + index;
    const uint firstSlot = index * range.sampleCount;
    ChannelSums red = loadSums(0u, pixel);
    ChannelSums green = loadSums(1u, pixel);
    ChannelSums blue = loadSums(2u, pixel);
    const uint saturatedBefore = saturatedSums(red, green, blue);
    uint dropped = 0u;
    for (uint slot = firstSlot; slot < firstSlot + range.sampleCount; ++slot) {
        const vec3 radiance = paths[slot].radiance;
        if (isFinite(radiance)) {
            addRadiance(red, radiance.x);
            addRadiance(green, radiance.y);
            addRadiance(blue, radiance.z);
        } else {
            ++dropped;
        }
    }
    const uint saturated = saturatedSums(red, green, blue) - saturatedBefore;
    storeSums(0u, pixel, red);
    storeSums(1u, pixel, green);
    storeSums(2u, pixel, blue);
    film[kCountPlane * frame.bandPixels + pixel] += range.sampleCount - dropped;
    if (saturated > 0u)
        addTally(kTallySaturated, saturated);
    if (dropped > 0u)
        addTally(kTallyDropped, dropped);
}
