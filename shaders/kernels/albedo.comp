#version 460
// Tabulates the directional albedos of the GGX lobe and of sheen with the functions that shading uses;
// scene/albedo_table.glsl reads them. Each table is rounded so that interpolation in it is never below the albedo: what an
// albedo leaves to the layers below is then never too much, and white surfaces stay below 1.
// Three dispatches of a workgroup a row: entries; their rounding; averages of the interpolated GGX rows.
#include "lib/bsdf/albedo_grid.glsl"
#include "lib/bsdf/sheen.glsl"
#include "lib/bsdf/specular.glsl"
#include "shared/bindings.h"

layout(local_size_x = 64) in; // an invocation for each of kAlbedoCosines
// The table of scene/albedo_table.glsl, then the entries as they were before rounding.
layout(set = 0, binding = BINDING_ALBEDO_OUT, std430) buffer AlbedoOut { vec4 albedo[]; };
layout(push_constant) uniform Push { uint stage; };

const uint kRaw = kAlbedoEntries + kAlbedoAverages;

// Integration points: a Fibonacci lattice. Directions lost below the horizon make the integrand jump, so a grid of 24 x 24
// is off by up to 0.011.
const uint kPoints = 1597u;
const uint kGenerator = 987u;
const vec3 kLatticeError = vec3(8e-4, 4e-4, 2e-3); // errors of what an entry holds (device test)

// The lobe is symmetric to the plane of wo: half a turn of the warp's first axis stands for all of it.
vec2 latticePoint(uint i) {
    return vec2(0.5 * (float(i) + 0.5), float(i * kGenerator % kPoints) + 0.5) / float(kPoints);
}

vec3 directionOf(float cosTheta) {
    return vec3(sqrt(max(0.0, 1.0 - cosTheta * cosTheta)), 0.0, cosTheta);
}

// What facets that reflect everything lose by masking, and the albedo of F90 alone, less that of a mirror: both are smooth
// where Schlick's curve is steep.
vec2 specularEntry(float cosTheta, float alpha) {
    const vec3 wo = directionOf(cosTheta);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < kPoints; ++i) {
        const vec3 m = squareToVisibleNormal(latticePoint(i), wo, vec2(alpha));
        const vec3 wi = reflect(-wo, m);
        const float weight = wi.z > 0.0 ? ggxG2(wo, wi, vec2(alpha)) / ggxG1(wo, vec2(alpha)) : 0.0;
        sum += vec2(1.0 - weight, weight * schlickWeight(dot(wo, m)));
    }
    return sum / float(kPoints) - vec2(0.0, schlickWeight(cosTheta));
}

// Entry of white sheen, whose lobe is even in the azimuth too. The warp's axes are swapped against those of GGX.
float sheenEntry(float cosTheta, float alpha) {
    const vec3 wo = directionOf(cosTheta);
    float sum = 0.0;
    for (uint i = 0u; i < kPoints; ++i) {
        const vec3 wi = sampleSheen(latticePoint(i).yx);
        sum += evalCharlie(alpha, wo, wi) / pdfSheen(wi);
    }
    return sum / float(kPoints);
}

vec3 rawEntry(uint column, uint row) {
    const float nearHorizon = 1e-5; // the limit at the horizon
    const float roughness = roughnessOfRow(float(row), kLeastTabulatedRoughness);
    const float cosTheta = max(cosineOfSpecularColumn(float(column), roughness), nearHorizon);
    const float sheen = roughnessOfRow(float(row), kLeastSheenRoughness);
    const float cosSheen = max(cosineOfSheenColumn(float(column)), nearHorizon);
    return vec3(specularEntry(cosTheta, roughness * roughness), sheenEntry(cosSheen, sheen * sheen));
}

vec3 rawAt(int column, int row) {
    column = clamp(column, 0, int(kAlbedoCosines) - 1);
    row = clamp(row, 0, int(kAlbedoRoughnesses) - 1);
    return albedo[kRaw + uint(row) * kAlbedoCosines + uint(column)].xyz;
}

// Second difference along a direction; at the rim, that of the next entry.
vec3 bend(int column, int row, ivec2 along) {
    column = clamp(column, along.x, int(kAlbedoCosines) - 1 - along.x);
    row = clamp(row, along.y, int(kAlbedoRoughnesses) - 1 - along.y);
    return rawAt(column - along.x, row - along.y) - 2.0 * rawAt(column, row) + rawAt(column + along.x, row + along.y);
}

// How far linear interpolation next to an entry may lie below (x above: of a loss, which is rounded down) what it
// interpolates: an eighth of the second difference in the middle between two entries. A sixth, as curvature is not constant.
vec3 interpolationError(int column, int row, ivec2 along) {
    vec3 error = vec3(0.0);
    for (int i = -1; i <= 1; ++i) {
        const vec3 b = bend(column + i * along.x, row + i * along.y, along);
        error = max(error, vec3(b.x, -b.yz) / 6.0);
    }
    return error;
}

vec3 roundedEntry(uint column, uint row) {
    const ivec2 at = ivec2(column, row);
    const vec3 raw = rawAt(at.x, at.y);
    const vec3 error = kLatticeError + interpolationError(at.x, at.y, ivec2(1, 0)) +
                       interpolationError(at.x, at.y, ivec2(0, 1));
    return vec3(max(0.0, raw.x - error.x), raw.yz + error.yz);
}

// 2 * integral of the interpolated table times the cosine, at a roughness between two rows or on one: Simpson's rule for
// each piece. Its error, of the order of the fifth power of a piece's length, is below rounding.
vec2 averageAt(float row) {
    const float roughness = roughnessOfRow(row, kLeastTabulatedRoughness);
    const uint j = min(uint(row), kAlbedoRoughnesses - 2u);
    float cosBefore = 0.0;
    vec2 before = vec2(0.0);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < kAlbedoCosines; ++i) {
        const uint entry = j * kAlbedoCosines + i;
        const vec2 here = mix(albedo[entry].xy, albedo[entry + kAlbedoCosines].xy, row - float(j));
        const float cosHere = cosineOfSpecularColumn(float(i), roughness);
        const float cosMiddle = 0.5 * (cosBefore + cosHere);
        const vec2 middle = mix(here, before, float(i) - specularColumn(cosMiddle, roughness));
        if (i > 0u)
            sum += (cosHere - cosBefore) / 6.0 * (cosBefore * before + 4.0 * cosMiddle * middle + cosHere * here);
        cosBefore = cosHere;
        before = here;
    }
    return 2.0 * sum;
}

void main() {
    const uint row = gl_WorkGroupID.x;
    const uint column = gl_LocalInvocationID.x;
    const uint entry = row * kAlbedoCosines + column;
    if (stage == 0u)
        albedo[kRaw + entry] = vec4(rawEntry(column, row), 0.0);
    if (stage == 1u)
        albedo[entry] = vec4(roundedEntry(column, row), 0.0);
    // The averages are interpolated, too: rounded so that the lobe below is divided by enough.
    if (stage == 2u && entry < kAlbedoAverages) {
        const vec2 average = averageAt(float(entry) / float(kAveragesPerRow));
        albedo[kAlbedoEntries + entry] = vec4(1.0001 * average.x, average.y, 0.0, 0.0);
    }
}
