#version 460
// Weights of both of two techniques with given densities.
#include "lib/sampling/mis.glsl"

struct Question {
    float own;
    float other;
    uint kind;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec2 weights[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= weights.length())
        return;
    const Question q = questions[i];
    weights[i] = vec2(misWeight(q.kind, q.own, q.other), misWeight(q.kind, q.other, q.own));
}
