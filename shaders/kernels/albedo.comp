#version 460
// Tabulates the directional albedos of the GGX lobe and of sheen with the functions that shading uses;
// scene/albedo_table.glsl reads them.
// One workgroup a row (roughness); the last column is the cosine-weighted average of the interpolated row.
#include "lib/bsdf_sheen.glsl"
#include "lib/bsdf_specular.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_ALBEDO_OUT, std430) buffer AlbedoOut { vec4 albedo[]; };
layout(push_constant) uniform Push { uint isAverage; };

// Integration points: a Fibonacci lattice. Directions lost below the horizon make the integrand jump, so a grid of 24 x 24
// is off by up to 0.011; these are off by 6e-4 at most (device test).
const uint kPoints = 1597u;
const uint kGenerator = 987u;

// The lobe is symmetric to the plane of wo: half a turn of the warp's first axis stands for all of it.
vec2 latticePoint(uint i) {
    return vec2(0.5 * (float(i) + 0.5), float(i * kGenerator % kPoints) + 0.5) / float(kPoints);
}

// The two terms of E = f0 x + f90 y; a smooth lobe is a mirror.
vec2 albedoTerms(float cosTheta, float alpha) {
    const vec3 wo = vec3(sqrt(max(0.0, 1.0 - cosTheta * cosTheta)), 0.0, cosTheta);
    if (alpha < kSmoothAlpha)
        return vec2(1.0 - schlickWeight(cosTheta), schlickWeight(cosTheta));
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < kPoints; ++i) {
        const vec3 m = squareToVisibleNormal(latticePoint(i), wo, vec2(alpha));
        const vec3 wi = reflect(-wo, m);
        if (wi.z <= 0.0)
            continue;
        const float weight = ggxG2(wo, wi, vec2(alpha)) / ggxG1(wo, vec2(alpha));
        const float s = schlickWeight(dot(wo, m));
        sum += weight * vec2(1.0 - s, s);
    }
    return sum / float(kPoints);
}

// Of white sheen, whose lobe is even in the azimuth too. The warp's axes are swapped against those of GGX.
float sheenAlbedo(float cosTheta, float roughness) {
    const float alpha = max(roughness * roughness, kLeastSheenRoughness * kLeastSheenRoughness);
    const vec3 wo = vec3(sqrt(max(0.0, 1.0 - cosTheta * cosTheta)), 0.0, cosTheta);
    float sum = 0.0;
    for (uint i = 0u; i < kPoints; ++i) {
        const vec3 wi = sampleSheen(latticePoint(i).yx);
        sum += evalCharlie(alpha, wo, wi) / pdfSheen(wi);
    }
    return sum / float(kPoints);
}

// 2 * integral of the row times the cosine c, where the row is linear in s = sqrt(c): 4 * integral of s^3. Simpson's rule for
// each piece; its error, of the order of the fifth power of a column's width, is below rounding.
vec2 rowAverage(uint row) {
    const float h = 1.0 / float(kAlbedoCosines - 1u);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i + 1u < kAlbedoCosines; ++i) {
        const vec2 a = albedo[row * kAlbedoRow + i].xy;
        const vec2 b = albedo[row * kAlbedoRow + i + 1u].xy;
        const vec3 s = (float(i) + vec3(0.0, 0.5, 1.0)) * h;
        const vec3 weights = vec3(1.0, 4.0, 1.0) * (h / 6.0) * s * s * s;
        sum += weights.x * a + weights.y * 0.5 * (a + b) + weights.z * b;
    }
    return 4.0 * sum;
}

void main() {
    const uint row = gl_WorkGroupID.x;
    const uint column = gl_LocalInvocationID.x;
    if (isAverage != 0u) {
        if (column == 0u)
            albedo[row * kAlbedoRow + kAlbedoCosines] = vec4(rowAverage(row), 0.0, 0.0);
        return;
    }
    const float roughness = float(row) / float(kAlbedoRoughnesses - 1u);
    const float root = float(column) / float(kAlbedoCosines - 1u);
    const float cosTheta = max(root * root, 1e-4); // the limit at the horizon
    albedo[row * kAlbedoRow + column] = vec4(albedoTerms(cosTheta, roughness * roughness), sheenAlbedo(cosTheta, roughness), 0.0);
}
