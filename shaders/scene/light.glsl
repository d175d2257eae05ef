// Lights: picking one, sampling it from a point, and the density with which that finds a direction.
#include "lib/features.glsl"
#include "lib/onb.glsl"
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

// The point that light is sampled for.
struct Receiver {
    vec3 p;
    vec3 n; // shading normal on the side of wo
};

// Probability of picking this light, for sampling and for MIS at BSDF hits alike.
float lightPmf(uint light) {
    return fetchLight(light).pmf;
}

struct LightPick {
    uint light;
    float place; // what is left of the random number: uniform in [0, 1) again
};

const float kLargestPlace = 1.0 - 5.9604644775390625e-8; // 1 - 2^-24

// Alias method: a column, then the light in it. Walker 1977; Vose 1991. The high word of bits * count is the column, the
// low word the place within it: one 32-bit number serves both, uneven by a relative count / 2^32. The place is then
// stretched over the part of the column that was met, so that one Sobol pair stratifies lights and points on them
// together: a quad's two triangles are one light to it.
LightPick pickLight(uint bits, uint lightCount) {
    uint column;
    uint word;
    umulExtended(bits, lightCount, column, word);
    const LightRecord record = fetchLight(column);
    const bool stays = bitsToUnit(word) < record.probability; // exact: both are multiples of 2^-24
    const float place = float(word) * 2.3283064365386963e-10; // 2^-32; rounding may carry it just out of its part
    const float stretched = stays ? place / record.probability : (place - record.probability) / (1.0 - record.probability);
    return LightPick(stays ? column : record.alias, clamp(stretched, 0.0, kLargestPlace));
}

// A constant environment is sampled by the cosine around the receiver's normal, which leaves a diffuse surface no variance
// but that of visibility. cosTheta: between normal and direction; what comes from behind is left to BSDF rays.
float environmentPdf(float cosTheta) {
    return squareToCosineHemispherePdf(cosTheta);
}

// `reach`: a distance beyond the scene.
LightSample sampleEnvironment(Receiver receiver, vec2 u, vec3 radiance, float reach) {
    const vec3 local = squareToCosineHemisphere(u);
    LightSample light;
    light.wi = toWorld(makeBasis(receiver.n), local);
    light.end = receiver.p + reach * light.wi;
    light.radiance = radiance;
    light.pdf = environmentPdf(local.z);
    light.isDelta = false;
    light.triangle = kNoTriangle;
    return light;
}

// Next-event estimation; frame.lightCount > 0. The pdf includes the pmf of the pick.
LightSample sampleLight(FrameParameters frame, Receiver receiver, uvec2 bits) {
    const LightPick pick = pickLight(bits.x, frame.lightCount);
    const vec2 u = vec2(pick.place, bitsToUnit(bits.y));
    const LightRecord record = fetchLight(pick.light);
    const uint kind = record.source >> kLightKindShift;
    const uint index = record.source & kLightIndexMask;
    const float reach = 2.0 * (frame.sceneRadius + distance(receiver.p, frame.sceneCenter));
    LightSample light = kNoLightSample;
    if (sceneHas(kFeatureTriangleLights) && kind == kLightTriangle)
        light = sampleTriangleLight(receiver.p, u, index);
    if (sceneHas(kFeaturePunctualLights) && kind == kLightPunctual)
        light = samplePunctualLight(receiver.p, index, reach);
    if (sceneHas(kFeatureEnvironment) && kind == kLightEnvironment)
        light = sampleEnvironment(receiver, u, frame.environment, reach);
    light.pdf *= record.pmf;
    return light;
}
