#version 460
// The lecture's rays: some of them are killed, and the others make up for it.
#include "scene/lab_estimator.glsl"

const uint kDimensionSurvival = 0u; // 1-D; a vertex of its own for each ray

float sampleOnce(SampleKey key) {
    const float power = run.a.x;
    const float survival = run.a.y;
    float sum = 0.0;
    for (uint ray = 0u; ray < run.count; ++ray) {
        key.vertex = ray;
        if (sample1D(key, kDimensionSurvival) < survival)
            sum += run.kind == kRouletteForgot ? power : power / survival;
    }
    return sum;
}
