#version 460
// Survival probabilities of paths.
#include "lib/roulette.glsl"

struct Question {
    vec3 throughput;
    uint kind;
    uint vertex;
    uint firstVertex;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { float survivals[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= survivals.length())
        return;
    const Question q = questions[i];
    survivals[i] = survivalProbability(q.kind, q.vertex, q.firstVertex, q.throughput);
}
