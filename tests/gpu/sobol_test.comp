#version 460
// The pair and the single number of pixels' samples, one after another, pixel by pixel.
#include "lib/sampling/sampler.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 1, std430) writeonly buffer Out { uvec4 words[]; };
layout(push_constant) uniform Push {
    uint firstPixel;
    uint samplesEach;
    uint vertex;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= words.length())
        return;
    const SampleKey key = SampleKey(0u, firstPixel + i / samplesEach, i % samplesEach, vertex);
    words[i] = uvec4(sampleBits2D(key, kDimensionBsdf), sampleBits1D(key, kDimensionLobe), 0u);
}
