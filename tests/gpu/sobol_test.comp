#version 460
// The pair and the single number of one pixel's samples, one after another.
#include "lib/sampler.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 1, std430) writeonly buffer Out { uvec4 words[]; };
layout(push_constant) uniform Push {
    uint pixel;
    uint vertex;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= words.length())
        return;
    const SampleKey key = SampleKey(0u, pixel, i, vertex);
    words[i] = uvec4(sampleBits2D(key, kDimensionBsdf), sampleBits1D(key, kDimensionLobe), 0u);
}
