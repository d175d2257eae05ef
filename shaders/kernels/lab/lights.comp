#version 460
// Irradiance from a large and a small light: one of them picked, then a direction in its cone.
#include "lib/math/constants.glsl"
#include "scene/lab_estimator.glsl"

const uint kDimensionDirection = 0u; // 2-D
const uint kDimensionPick = 1u;      // 1-D

// The cosine to the normal of a direction uniform in the cone around `light`.
float sampleConeCosine(vec4 light, vec2 u) {
    const float cosCenter = light.x;
    const float fall = light.y * u.x; // 1 - cosine to the cone's axis, which keeps its digits for narrow cones
    const float sinAxis = sqrt(fall * (2.0 - fall));
    const float sinCenter = sqrt(1.0 - cosCenter * cosCenter);
    return (1.0 - fall) * cosCenter + sinAxis * sinCenter * cos(2.0 * kPi * u.y);
}

float sampleOnce(SampleKey key) {
    const bool picksFirst = sample1D(key, kDimensionPick) < run.a.w;
    const vec4 light = picksFirst ? run.a : run.b;
    const float cosTheta = sampleConeCosine(light, sample2D(key, kDimensionDirection));
    const float pdf = 1.0 / (2.0 * kPi * light.y);
    return light.z * cosTheta / (pdf * light.w);
}
