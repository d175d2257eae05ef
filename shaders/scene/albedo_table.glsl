// The tabulated directional albedos of the GGX lobe and of sheen that lib/bsdf/layers.glsl asks for. kernels/albedo.comp
// has rounded them so that none is less than what the lobe reflects, between the entries neither: what lies below then
// never gets too much.
#include "lib/bsdf/albedo_grid.glsl"
#include "lib/bsdf/sheen.glsl"
#include "lib/features.glsl"
#include "lib/bsdf/fresnel.glsl"
#include "shared/bindings.h"

layout(set = 0, binding = BINDING_ALBEDO_TABLE) uniform utextureBuffer albedoTable;

vec3 fetchAlbedo(uint entry) {
    return uintBitsToFloat(texelFetch(albedoTable, int(entry)).xyz);
}

vec3 interpolateAlbedo(float column, float row) {
    const uint i = min(uint(column), kAlbedoCosines - 2u);
    const uint j = min(uint(row), kAlbedoRoughnesses - 2u);
    const uint first = j * kAlbedoCosines + i;
    const float x = column - float(i);
    const vec3 below = mix(fetchAlbedo(first), fetchAlbedo(first + 1u), x);
    const vec3 above = mix(fetchAlbedo(first + kAlbedoCosines), fetchAlbedo(first + kAlbedoCosines + 1u), x);
    return mix(below, above, row - float(j));
}

bool isMirror(float alpha) {
    return !sceneHas(kFeatureRoughLobes) || alpha < kSmoothAlpha;
}

// x: what white facets lose; y: albedo of F90 alone, which the table holds without that of a mirror.
vec2 specularEntry(float cosTheta, float alpha) {
    vec2 entry = vec2(0.0, schlickWeight(cosTheta));
    const float roughness = sqrt(alpha);
    if (!isMirror(alpha))
        entry += interpolateAlbedo(specularColumn(cosTheta, roughness),
                                   albedoRow(roughness, kLeastTabulatedRoughness)).xy;
    return entry;
}

vec2 specularAlbedoTerms(float cosTheta, float alpha) {
    const vec2 entry = specularEntry(cosTheta, alpha);
    return vec2(1.0 - entry.x - entry.y, entry.y);
}

float specularMaskingLoss(float cosTheta, float alpha) {
    return specularEntry(cosTheta, alpha).x;
}

// Averages of specularEntry() over the hemisphere by the cosine.
vec2 specularAverageEntry(float alpha) {
    vec2 entry = vec2(0.0, 1.0 / 21.0); // 2 * integral of schlickWeight(c) c
    const float place = float(kAveragesPerRow) * albedoRow(sqrt(alpha), kLeastTabulatedRoughness);
    const uint i = min(uint(place), kAlbedoAverages - 2u);
    if (!isMirror(alpha))
        entry += mix(fetchAlbedo(kAlbedoEntries + i), fetchAlbedo(kAlbedoEntries + i + 1u), place - float(i)).xy;
    return entry;
}

vec2 specularAlbedoAverage(float alpha) {
    const vec2 entry = specularAverageEntry(alpha);
    return vec2(1.0 - entry.x - entry.y, entry.y);
}

float specularMaskingLossAverage(float alpha) {
    return specularAverageEntry(alpha).x;
}

float charlieAlbedo(float cosTheta, float alpha) {
    return interpolateAlbedo(sheenColumn(cosTheta), albedoRow(sqrt(alpha), kLeastSheenRoughness)).z;
}
