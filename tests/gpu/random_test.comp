#version 460
// The random words of given keys.
#include "lib/random.glsl"

struct Key {
    uint seed, pixel, index, vertex, dimension;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Key keys[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { uvec4 words[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= words.length())
        return;
    const Key key = keys[i];
    words[i] = sampleBits(SampleKey(key.seed, key.pixel, key.index, key.vertex), key.dimension);
}
