#version 460
// Irradiance under a sky: directions all alike, or by the cosine, with the warps that the renderer uses.
#include "lib/sampling/warp.glsl"
#include "scene/lab_estimator.glsl"

const uint kDimensionDirection = 0u; // 2-D

// CIE standard overcast sky (Moon, Spencer 1942): radiance by the sine of the elevation, which is the cosine to the zenith.
float skyRadiance(float cosTheta) {
    return run.variant == kSkyOvercast ? (1.0 + 2.0 * cosTheta) / 3.0 : 1.0;
}

float sampleOnce(SampleKey key) {
    const vec2 u = sample2D(key, kDimensionDirection);
    const bool isUniform = run.kind == kHemisphereUniform;
    const float cosTheta = isUniform ? squareToUniformHemisphere(u).z : squareToCosineHemisphere(u).z;
    const float pdf = isUniform ? squareToUniformHemispherePdf(cosTheta) : squareToCosineHemispherePdf(cosTheta);
    return pdf > 0.0 ? skyRadiance(cosTheta) * cosTheta / pdf : 0.0; // the horizon: no light, and no density
}
