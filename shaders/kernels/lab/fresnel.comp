#version 460
// What a smooth surface of glass reflects of diffuse light: exact Fresnel's equations or Schlick's approximation.
#include "lib/bsdf/fresnel.glsl"
#include "lib/sampling/warp.glsl"
#include "scene/lab_estimator.glsl"

const uint kDimensionDirection = 0u; // 2-D

float sampleOnce(SampleKey key) {
    const float cosTheta = squareToCosineHemisphere(sample2D(key, kDimensionDirection)).z;
    const float eta = run.a.x;
    return run.kind == kFresnelSchlick ? schlickDielectric(cosTheta, eta) : fresnelDielectric(cosTheta, eta);
}
