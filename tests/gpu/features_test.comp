#version 460
// Says of features of both words whether the scene has them.
#include "lib/features.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 21, std430) writeonly buffer Out { uint answers[]; };

void main() {
    if (gl_GlobalInvocationID.x > 0u)
        return;
    answers[0] = sceneHas(kFeatureSpecular) ? 1u : 0u; // the lowest bits of both words
    answers[1] = sceneHas(kFeatureLens) ? 1u : 0u;
    answers[2] = sceneHas(kFeatureSmoothLobes) ? 1u : 0u; // the same bit of both
    answers[3] = sceneHas(kFeatureSolids) ? 1u : 0u;
    answers[4] = sceneHas(31u) ? 1u : 0u; // the highest of both
    answers[5] = sceneHas(63u) ? 1u : 0u;
}
