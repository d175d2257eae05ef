// Lights: picking one, sampling it from a point, and the density with which that finds a direction.
#include "lib/random.glsl"
#include "scene/punctual_light.glsl"
#include "scene/triangle_light.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"

layout(set = 0, binding = BINDING_LIGHTS) uniform usamplerBuffer lights;

LightRecord fetchLight(uint index) {
    const uvec4 l = texelFetch(lights, int(index));
    return LightRecord(uintBitsToFloat(l.x), l.y, uintBitsToFloat(l.z), l.w);
}

// Probability of picking this light, for sampling and for MIS at BSDF hits alike.
float lightPmf(uint light) {
    return fetchLight(light).pmf;
}

// Alias method: a column, then the light in it. Walker 1977; Vose 1991. The high word of bits * count is the column, the
// low word the place within it: one 32-bit number serves both, uneven by a relative count / 2^32.
uint pickLight(uint bits, uint lightCount) {
    uint column;
    uint place;
    umulExtended(bits, lightCount, column, place);
    const LightRecord record = fetchLight(column);
    return bitsToUnit(place) < record.probability ? column : record.alias;
}

// A constant environment is a sphere at infinity; `reach` is a distance beyond the scene.
LightSample sampleEnvironment(vec3 from, vec2 u, vec3 radiance, float reach) {
    LightSample light;
    light.wi = squareToSphere(u);
    light.end = from + reach * light.wi;
    light.radiance = radiance;
    light.pdf = squareToSpherePdf();
    light.isDelta = false;
    light.triangle = kNoTriangle;
    return light;
}

// Next-event estimation from the point `from`; frame.lightCount > 0. The pdf includes the pmf of the pick.
LightSample sampleLight(FrameParameters frame, vec3 from, uint pickBits, vec2 u) {
    const LightRecord record = fetchLight(pickLight(pickBits, frame.lightCount));
    const uint kind = record.source >> kLightKindShift;
    const uint index = record.source & kLightIndexMask;
    const float reach = 2.0 * (frame.sceneRadius + distance(from, frame.sceneCenter));
    LightSample light;
    if (kind == kLightTriangle)
        light = sampleTriangleLight(from, u, index);
    else if (kind == kLightPunctual)
        light = samplePunctualLight(from, index, reach);
    else
        light = sampleEnvironment(from, u, frame.environment, reach);
    light.pdf *= record.pmf;
    return light;
}
