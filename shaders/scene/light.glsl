// Lights: picking one, sampling it from a point, and the density with which that finds a direction.
#include "lib/features.glsl"
#include "lib/sampling/random.glsl"
#include "scene/environment.glsl"
#include "scene/light_tree.glsl"
#include "scene/punctual_light.glsl"
#include "scene/receiver.glsl"
#include "scene/triangle_light.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"

layout(set = 0, binding = BINDING_LIGHTS) uniform utextureBuffer lights;

LightRecord fetchLight(uint index) {
    const uvec4 l = texelFetch(lights, int(index));
    return LightRecord(uintBitsToFloat(l.x), l.y, uintBitsToFloat(l.z), l.w);
}

bool isInLightTree(FrameParameters parameters, uint light) {
    return sceneHas(kFeatureLightTree) && light < parameters.firstLightColumn;
}

// Probability of picking this light, for sampling and for MIS at BSDF hits alike.
float lightPmf(FrameParameters parameters, Receiver receiver, uint light) {
    const LightRecord record = fetchLight(light);
    return isInLightTree(parameters, light) ? record.pmf * lightTreePmf(receiver, record.alias) : record.pmf;
}

// Probability of picking the environment, which is at infinity and so in no tree.
float environmentPmf(FrameParameters parameters) {
    return fetchLight(parameters.environmentLight).pmf;
}

struct LightPick {
    uint light;
    float pmf;   // 0: no light brings anything
    float place; // what is left of the random number: uniform in [0, 1) again
};

const float kLargestPlace = 1.0 - 5.9604644775390625e-8; // 1 - 2^-24
const float kLowBitsToUnit = 2.3283064365386963e-10;     // 2^-32

// The alias method picks a column, then the light in it (Walker 1977; Vose 1991). The high word of bits * columns is the
// column, the low word the place within it: one 32-bit number serves both, uneven by a relative columns / 2^32. The place is
// then stretched over the part of the column that was met, and so on down the light tree, so that one Sobol pair stratifies
// lights and points on them together: a quad's two triangles are one light to it. The tree decides by 24 bits of the
// place, and the other 8 make up for what stretching uses up.
LightPick pickLight(FrameParameters parameters, Receiver receiver, uint bits) {
    uint column;
    uint word;
    umulExtended(bits, parameters.lightColumns, column, word);
    column += parameters.firstLightColumn;
    const LightRecord record = fetchLight(column);
    const float place = bitsToUnit(word);
    const bool stays = place < record.probability; // exact: both are multiples of 2^-24
    const float share = stays ? record.probability : 1.0 - record.probability;
    const float stretched = (stays ? place : place - record.probability) / share;
    const LightRecord picked = stays ? record : fetchLight(record.alias);
    LightPick pick = LightPick(stays ? column : record.alias, picked.pmf, stretched);
    float rest = kLowBitsToUnit * float(word & 0xffu) / share;
    if (sceneHas(kFeatureLightTree) && picked.source >> kLightKindShift == kLightTree) {
        const LightTreePick inTree = pickFromLightTree(receiver, stretched);
        pick = LightPick(inTree.light, picked.pmf * inTree.pmf, inTree.place);
        rest /= inTree.pmf;
    }
    pick.place = clamp(pick.place + rest, 0.0, kLargestPlace);
    return pick;
}

// Draws a light sample for next-event estimation; parameters.lightColumns > 0. `n`: the shading normal, which the receiver
// has but roughly. The pdf includes the pmf of the pick.
LightSample sampleLight(FrameParameters parameters, Receiver receiver, vec3 n, uvec2 bits) {
    const LightPick pick = pickLight(parameters, receiver, bits.x);
    const vec2 u = vec2(pick.place, bitsToUnit(bits.y));
    const uint source = fetchLight(pick.light).source;
    const uint kind = source >> kLightKindShift;
    const uint index = source & kLightIndexMask;
    const float reach = 2.0 * (parameters.sceneRadius + distance(receiver.p, parameters.sceneCenter));
    LightSample light = kNoLightSample;
    if (sceneHas(kFeatureTriangleLights) && kind == kLightTriangle)
        light = sampleTriangleLight(receiver.p, u, index);
    if (sceneHas(kFeaturePunctualLights) && kind == kLightPunctual)
        light = samplePunctualLight(receiver.p, index, reach);
    if ((sceneHas(kFeatureEnvironment) || sceneHas(kFeatureEnvironmentMap)) && kind == kLightEnvironment)
        light = sampleEnvironment(parameters, receiver.p, n, u, reach);
    light.pdf *= pick.pmf;
    return light;
}
