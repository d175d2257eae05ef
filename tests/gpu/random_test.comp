#version 460
// The pairs of sample words of given keys.
#include "lib/sampling/sampler.glsl"

struct Key {
    uint seed, pixel, index, vertex, dimension;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Key keys[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { uvec2 words[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= words.length())
        return;
    const SampleKey key = SampleKey(keys[i].seed, keys[i].pixel, keys[i].index, keys[i].vertex);
    words[i] = sampleBits2D(key, keys[i].dimension);
}
