#version 460
// Survival probabilities of paths, by albedo and by throughput, and which paths are spared.
#include "lib/sampling/roulette.glsl"

struct Question {
    vec3 color; // throughput, or albedo
    uint kind;
    uint vertex;
    uint isSmooth;
    uint pad0, pad1;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 survivals[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= survivals.length())
        return;
    const Question q = questions[i];
    survivals[i] = vec4(survivalByAlbedo(q.kind, 0.3, q.color), survivalByThroughput(q.kind, q.color),
                        isSpared(q.kind, q.vertex, q.isSmooth != 0u) ? 1.0 : 0.0, 0.0);
}
