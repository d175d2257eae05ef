// The tabulated directional albedos of the GGX lobe and of sheen that lib/bsdf_layers.glsl asks for.
#include "shared/bindings.h"
#include "shared/scene.h"

layout(set = 0, binding = BINDING_ALBEDO_TABLE) uniform usamplerBuffer albedoTable;

vec3 fetchAlbedo(uint column, uint row) {
    return uintBitsToFloat(texelFetch(albedoTable, int(row * kAlbedoRow + column)).xyz);
}

// Row below and its distance, on a grid that is even in roughness = sqrt(alpha).
float albedoRowOf(float alpha) {
    return clamp(sqrt(alpha), 0.0, 1.0) * float(kAlbedoRoughnesses - 1u);
}

// Columns are even in the square root of the cosine: over nearly smooth surfaces the albedo changes within the last
// degrees before the horizon.
vec3 interpolateAlbedo(float cosTheta, float alpha) {
    const float x = sqrt(clamp(cosTheta, 0.0, 1.0)) * float(kAlbedoCosines - 1u);
    const float y = albedoRowOf(alpha);
    const uint column = min(uint(x), kAlbedoCosines - 2u);
    const uint row = min(uint(y), kAlbedoRoughnesses - 2u);
    const float fx = x - float(column);
    const vec3 below = mix(fetchAlbedo(column, row), fetchAlbedo(column + 1u, row), fx);
    const vec3 above = mix(fetchAlbedo(column, row + 1u), fetchAlbedo(column + 1u, row + 1u), fx);
    return mix(below, above, y - float(row));
}

vec2 specularAlbedoTerms(float cosTheta, float alpha) {
    return interpolateAlbedo(cosTheta, alpha).xy;
}

vec2 specularAlbedoAverage(float alpha) {
    const float y = albedoRowOf(alpha);
    const uint row = min(uint(y), kAlbedoRoughnesses - 2u);
    return mix(fetchAlbedo(kAlbedoCosines, row), fetchAlbedo(kAlbedoCosines, row + 1u), y - float(row)).xy;
}

float charlieAlbedo(float cosTheta, float alpha) {
    return interpolateAlbedo(cosTheta, alpha).z;
}
