#version 460
// Random words as numbers in [0, 1).
#include "lib/sampling/random.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { uint words[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { float numbers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < numbers.length())
        numbers[i] = bitsToUnit(words[i]);
}
