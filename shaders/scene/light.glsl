// Emissive triangles as lights: picking one, a point on it, and the density with which that point is found.
#include "lib/random.glsl"
#include "lib/warp.glsl"
#include "scene/leaf_triangle.glsl"
#include "scene/material.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"

layout(set = 0, binding = BINDING_EMITTERS) uniform usamplerBuffer emitters;

EmitterRecord fetchEmitter(uint index) {
    const uvec4 e = texelFetch(emitters, int(index));
    return EmitterRecord(uintBitsToFloat(e.x), e.y, uintBitsToFloat(e.z), e.w);
}

// Probability of picking this emitter, for sampling and for MIS at BSDF hits alike.
float emitterPmf(uint emitter) {
    return fetchEmitter(emitter).pmf;
}

// Alias method: a column, then the emitter in it. Walker 1977; Vose 1991. The high word of bits * count is the column,
// the low word the place within it: one 32-bit number serves both, uneven by a relative count / 2^32.
uint pickEmitter(uint bits, uint emitterCount) {
    uint column;
    uint place;
    umulExtended(bits, emitterCount, column, place);
    const EmitterRecord record = fetchEmitter(column);
    return float(place >> 8u) * 5.9604644775390625e-8 < record.probability ? column : record.alias;
}

// Density per area turned into density per solid angle: distance^2 / |cos| as seen from the receiver.
float areaToSolidAngle(float pdfArea, float distance2, float cosLight) {
    return pdfArea * distance2 / max(abs(cosLight), 1e-20);
}

struct LightSample {
    vec3 p;        // on the light
    vec3 pError;
    uint triangle; // id
    vec3 ng;       // the light's geometric normal, front side
    vec3 wi;       // unit, towards the light
    vec3 emission; // 0: the light does not shine this way
    float pdf;     // per solid angle, including the pmf of the pick
};

// Next-event estimation from the point `from`; emitterCount > 0.
LightSample sampleLight(vec3 from, uvec4 bits, uint emitterCount) {
    const uint emitter = pickEmitter(bits.z, emitterCount);
    const EmitterRecord record = fetchEmitter(emitter);
    const LeafTriangle triangle = loadLeafTriangle(record.leafTriangle);
    const vec2 b = squareToTriangle(bitsToUnit(bits.xyz).xy);
    const vec3 weights = vec3(1.0 - b.x - b.y, b);
    const vec3 normal = cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
    const float twiceArea = length(normal);
    LightSample light;
    light.p = weights.x * triangle.v0 + weights.y * triangle.v1 + weights.z * triangle.v2;
    light.pError = hitPointError(weights, triangle.v0, triangle.v1, triangle.v2);
    light.triangle = triangle.triangle;
    light.ng = normal / twiceArea;
    const vec3 d = light.p - from;
    const float distance2 = dot(d, d);
    light.wi = d * inversesqrt(max(distance2, 1e-37));
    const float cosLight = -dot(light.wi, light.ng);
    light.pdf = areaToSolidAngle(record.pmf * squareToTrianglePdfArea(0.5 * twiceArea), distance2, cosLight);
    const MaterialRecord material = fetchMaterial(triangle.material & kMaterialMask);
    light.emission = cosLight != 0.0 && distance2 > 0.0 ? emissionOf(material, cosLight > 0.0) : vec3(0.0);
    return light;
}
