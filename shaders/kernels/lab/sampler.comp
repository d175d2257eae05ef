#version 460
// Integrals over the unit square by the renderer's samplers: independent numbers or Sobol's, as specialised.
#include "scene/lab_estimator.glsl"

const uint kDimensionPoint = 0u; // 2-D

// Integrands are rational functions: the error of a driver's exp or sin would be taken for the sampler's.
float sampleOnce(SampleKey key) {
    const vec2 p = sample2D(key, kDimensionPoint);
    if (run.variant == kIntegrandBump)
        return 36.0 * p.x * (1.0 - p.x) * p.y * (1.0 - p.y);
    if (run.variant == kIntegrandSlope)
        return 1.0 / (1.0 + p.x + p.y);
    if (run.variant == kIntegrandRidge)
        return 1.0 / (1.0 + 25.0 * (p.x - p.y) * (p.x - p.y));
    return dot(p, p) < 1.0 ? 1.0 : 0.0;
}
