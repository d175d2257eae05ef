#version 460
// Survival probabilities of paths, by albedo and by throughput.
#include "lib/sampling/roulette.glsl"

struct Question {
    vec3 color; // throughput, or albedo
    uint kind;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec2 survivals[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= survivals.length())
        return;
    const Question q = questions[i];
    survivals[i] = vec2(survivalByAlbedo(q.kind, 0.3, q.color), survivalByThroughput(q.kind, q.color));
}
