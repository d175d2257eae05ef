#version 460
// Bases around unit vectors.
#include "lib/math/onb.glsl"

struct Answer {
    vec4 tangent;
    vec4 bitangent;
    vec4 normal;
    vec4 thereAndBack; // toWorld(toLocal(v)) of a fixed v
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { vec4 normals[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { Answer answers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const Basis b = makeBasis(normals[i].xyz);
    const vec3 v = toWorld(b, toLocal(b, vec3(0.48, -0.6, 0.64)));
    answers[i] = Answer(vec4(b.tangent, 0), vec4(b.bitangent, 0), vec4(b.normal, 0), vec4(v, 0));
}
