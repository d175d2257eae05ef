#version 460
// Unpacks unit vectors.
#include "lib/math/octahedral.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { uint words[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 vectors[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < vectors.length())
        vectors[i] = vec4(decodeOctahedral(words[i]), 0.0);
}
