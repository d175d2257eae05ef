// Point, spot and directional lights. Based on: KHR_lights_punctual; candela and lux are taken as W/sr and W/m^2.
#include "lib/features.glsl"
#include "lib/sampling/range_window.glsl"
#include "scene/light_sample.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"
#include "shared/wavefront.h"

layout(set = 0, binding = BINDING_PUNCTUALS) uniform utextureBuffer punctuals;

PunctualRecord fetchPunctual(uint index) {
    const int first = int(kPunctualTexels * index);
    const uvec4 a = texelFetch(punctuals, first);
    const uvec4 b = texelFetch(punctuals, first + 1);
    const uvec4 c = texelFetch(punctuals, first + 2);
    float inverseRange2 = 0.0;
    if (sceneHas(kFeatureLightRange))
        inverseRange2 = uintBitsToFloat(texelFetch(punctuals, first + 3).x);
    return PunctualRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
                          uintBitsToFloat(c.xyz), uintBitsToFloat(c.w), inverseRange2, float[3](0.0, 0.0, 0.0));
}

// Falloff between the inner and the outer cone, as the extension gives it.
float coneFactor(PunctualRecord light, vec3 wi) {
    if (light.kind != kPunctualSpot)
        return 1.0;
    const float f = clamp(-dot(wi, light.direction) * light.coneScale + light.coneOffset, 0.0, 1.0);
    return f * f;
}

// `reach`: a distance beyond the scene.
LightSample samplePunctualLight(vec3 from, uint index, float reach) {
    const PunctualRecord record = fetchPunctual(index);
    LightSample light;
    light.pdf = 1.0;
    light.isDelta = true;
    light.surface = kNoSurface;
    if (record.kind == kPunctualDirectional) {
        light.wi = -record.direction;
        light.end = from + reach * light.wi;
        light.radiance = record.intensity;
        return light;
    }
    const vec3 d = record.position - from;
    const float distance2 = max(dot(d, d), 1e-37);
    light.wi = d * inversesqrt(distance2);
    light.end = record.position;
    light.radiance = record.intensity * (coneFactor(record, light.wi) / distance2);
    if (sceneHas(kFeatureLightRange))
        light.radiance *= rangeWindow(distance2, record.inverseRange2);
    return light;
}
