// What shines where rays hit nothing: one radiance from all sides, or an equirectangular map.
#include "lib/math/equirectangular.glsl"
#include "lib/features.glsl"
#include "lib/math/onb.glsl"
#include "lib/sampling/warp.glsl"
#include "scene/light_sample.glsl"
#include "scene/sun.glsl"
#include "shared/bindings.h"
#include "shared/frame.h"

layout(set = 0, binding = BINDING_ENVIRONMENT_MAP) uniform utextureBuffer environmentMap; // texel and scale of each cell
layout(set = 0, binding = BINDING_ENVIRONMENT_TABLE) uniform utextureBuffer environmentQuads; // light/environment.h

// The map turned by --env-rotation: what was in direction phi is in direction phi - rotation then.
vec2 environmentPoint(FrameParameters parameters, vec3 wi) {
    vec2 uv = directionToEquirectangular(wi);
    uv.x = fract(uv.x + parameters.environmentRotation);
    return uv;
}

vec4 fetchEnvironment(FrameParameters parameters, uvec2 texel) {
    return uintBitsToFloat(texelFetch(environmentMap, int(texel.y * parameters.environmentWidth + texel.x)));
}

// The corners of a cell (light/environment.h).
struct EnvironmentCell {
    vec3 topLeft;
    vec3 topRight;
    vec3 bottomLeft;
    vec3 bottomRight;
    float scale; // factor of the density
};

EnvironmentCell fetchEnvironmentCell(FrameParameters parameters, uvec2 cell) {
    const uint left = (cell.x == 0u ? parameters.environmentWidth : cell.x) - 1u;
    const uint above = max(cell.y, 1u) - 1u;
    const vec4 last = fetchEnvironment(parameters, cell);
    return EnvironmentCell(fetchEnvironment(parameters, uvec2(left, above)).xyz,
                           fetchEnvironment(parameters, uvec2(cell.x, above)).xyz,
                           fetchEnvironment(parameters, uvec2(left, cell.y)).xyz, last.xyz, last.w);
}

vec3 interpolated(EnvironmentCell cell, vec2 place) {
    return mix(mix(cell.topLeft, cell.topRight, place.x), mix(cell.bottomLeft, cell.bottomRight, place.x), place.y);
}

float environmentDensity(EnvironmentCell cell, vec2 place) {
    return cell.scale * dot(interpolated(cell, place), vec3(1.0));
}

// The parallels v that bound a row of cells.
vec2 environmentRow(FrameParameters parameters, uint row) {
    return clamp((vec2(row) + vec2(-0.5, 0.5)) / float(parameters.environmentHeight), 0.0, 1.0);
}

// A cell, and a place in it by u and v.
struct EnvironmentPlace {
    uvec2 cell;
    vec2 place;
};

EnvironmentPlace environmentPlace(FrameParameters parameters, vec2 uv) {
    const vec2 p = uv * vec2(parameters.environmentWidth, parameters.environmentHeight) + 0.5;
    const uvec2 cell = min(uvec2(p), uvec2(parameters.environmentWidth, parameters.environmentHeight));
    return EnvironmentPlace(uvec2(cell.x % parameters.environmentWidth, cell.y), p - vec2(cell));
}

vec3 environmentRadiance(FrameParameters parameters, vec3 wi) {
    if (!sceneHas(kFeatureEnvironmentMap))
        return parameters.environment;
    const EnvironmentPlace p = environmentPlace(parameters, environmentPoint(parameters, wi));
    return parameters.environment * (interpolated(fetchEnvironmentCell(parameters, p.cell), p.place) +
                                     sunRadiance(parameters, wi));
}

// A constant environment is sampled by the cosine around the receiver's normal, which leaves a diffuse surface no variance
// but that of visibility; what comes from behind is left to BSDF rays. cosTheta: between normal and direction.
float environmentPdf(FrameParameters parameters, vec3 wi, float cosTheta) {
    if (!sceneHas(kFeatureEnvironmentMap))
        return squareToCosineHemispherePdf(cosTheta);
    const vec2 uv = environmentPoint(parameters, wi);
    EnvironmentPlace p = environmentPlace(parameters, uv);
    p.place.y = equirectangularRowToUnit(uv.y, environmentRow(parameters, p.cell.y));
    return withSunPdf(parameters, wi, environmentDensity(fetchEnvironmentCell(parameters, p.cell), p.place));
}

const float kLargestPlaceInCell = 1.0 - 5.9604644775390625e-8; // 1 - 2^-24

// Goes with the first of two parts with probability p; u becomes the place within the part.
bool isSecond(float p, inout float u) {
    const bool second = u >= p;
    u = min(second ? (u - p) / (1.0 - p) : u / p, kLargestPlaceInCell);
    return second;
}

EnvironmentPlace pickEnvironmentCell(FrameParameters parameters, vec2 u) {
    const uvec2 cells = uvec2(parameters.environmentWidth, parameters.environmentHeight + 1u);
    EnvironmentPlace pick = EnvironmentPlace(uvec2(0u), u);
    uint start = 0u;
    const float levels = uintBitsToFloat(texelFetch(environmentQuads, 0).w); // by a parameter alone, lavapipe would unroll it
    for (int level = int(levels) - 1; level >= 0; --level) {
        const uvec2 quads = (cells + (2u << level) - 1u) >> (level + 1);
        const vec3 quad =
            uintBitsToFloat(texelFetch(environmentQuads, int(start + pick.cell.y * quads.x + pick.cell.x)).xyz);
        const bool isBottom = isSecond(quad.x, pick.place.y);
        const bool isRight = isSecond(isBottom ? quad.z : quad.y, pick.place.x);
        pick.cell = 2u * pick.cell + uvec2(isRight ? 1u : 0u, isBottom ? 1u : 0u);
        start += quads.x * quads.y;
    }
    return pick;
}

// Place in a cell by the density of environmentDensity: a row by what both its ends have, then a place along it.
vec2 squareToEnvironmentCell(vec2 u, EnvironmentCell cell) {
    const vec4 ends = vec4(dot(cell.topLeft, vec3(1.0)), dot(cell.topRight, vec3(1.0)), dot(cell.bottomLeft, vec3(1.0)),
                           dot(cell.bottomRight, vec3(1.0)));
    const float y = unitToLinear(u.y, ends.x + ends.y, ends.z + ends.w);
    const vec2 row = mix(ends.xy, ends.zw, y);
    return vec2(unitToLinear(u.x, row.x, row.y), y);
}

LightSample sampleEnvironmentMap(FrameParameters parameters, vec2 u) {
    if (sceneHas(kFeatureSun) && !isSecond(parameters.sunShare, u.x)) {
        LightSample sun = kNoLightSample;
        sun.wi = squareToSun(parameters, u);
        sun.radiance = environmentRadiance(parameters, sun.wi);
        sun.pdf = environmentPdf(parameters, sun.wi, 1.0);
        return sun;
    }
    const EnvironmentPlace pick = pickEnvironmentCell(parameters, u);
    const EnvironmentCell cell = fetchEnvironmentCell(parameters, pick.cell);
    const vec2 place = squareToEnvironmentCell(pick.place, cell);
    const float column = (float(pick.cell.x) - 0.5 + place.x) / float(parameters.environmentWidth);
    LightSample light = kNoLightSample;
    light.wi = unitToEquirectangularRow(column - parameters.environmentRotation, place.y,
                                        environmentRow(parameters, pick.cell.y));
    light.radiance = environmentRadiance(parameters, light.wi);
    light.pdf = withSunPdf(parameters, light.wi, environmentDensity(cell, place));
    return light;
}

LightSample sampleConstantEnvironment(FrameParameters parameters, vec3 n, vec2 u) {
    const vec3 local = squareToCosineHemisphere(u);
    LightSample light = kNoLightSample;
    light.wi = toWorld(makeBasis(n), local);
    light.radiance = parameters.environment;
    light.pdf = squareToCosineHemispherePdf(local.z);
    return light;
}

// `reach`: a distance beyond the scene.
LightSample sampleEnvironment(FrameParameters parameters, vec3 from, vec3 n, vec2 u, float reach) {
    LightSample light = kNoLightSample;
    if (sceneHas(kFeatureEnvironment))
        light = sampleConstantEnvironment(parameters, n, u);
    if (sceneHas(kFeatureEnvironmentMap))
        light = sampleEnvironmentMap(parameters, u);
    light.end = from + reach * light.wi;
    light.isDelta = false;
    return light;
}
