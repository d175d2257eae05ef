// Clearcoat, a GGX lobe of a clear varnish in a basis of its own: sample, eval, pdf. Smooth coats are a delta in bsdf.glsl.
// Based on: KHR_materials_clearcoat. The layers below are dimmed by the caller.
#include "lib/bsdf/specular.glsl"
#include "lib/math/onb.glsl"

const float kClearcoatF0 = 0.04; // index 1.5

struct Clearcoat {
    float weight;
    float alpha;
    vec3 normal; // in the surface's local basis
};

float clearcoatFresnel(float cosTheta) {
    return mix(kClearcoatF0, 1.0, schlickWeight(cosTheta));
}

vec3 toClearcoat(Clearcoat c, vec3 w) {
    return toLocal(makeBasis(c.normal), w);
}

// Draws wi; 0 if it is lost, below the horizon of the coat or of the surface.
vec3 sampleClearcoat(Clearcoat c, vec2 u, vec3 wo) {
    const vec3 o = toClearcoat(c, wo);
    const vec3 wi = toWorld(makeBasis(c.normal), sampleSpecular(u, vec3(o.xy, max(o.z, 1e-4)), vec2(c.alpha)));
    return o.z > 0.0 && wi.z > 0.0 ? wi : vec3(0.0);
}

float evalClearcoat(Clearcoat c, vec3 wo, vec3 wi) {
    const vec3 o = toClearcoat(c, wo);
    const vec3 i = toClearcoat(c, wi);
    if (o.z <= 0.0 || i.z <= 0.0)
        return 0.0;
    const vec3 m = normalize(o + i);
    return c.weight * clearcoatFresnel(dot(o, m)) * evalFacets(vec2(c.alpha), o, i, m);
}

float pdfClearcoat(Clearcoat c, vec3 wo, vec3 wi) {
    const vec3 o = toClearcoat(c, wo);
    const vec3 i = toClearcoat(c, wi);
    return o.z > 0.0 && i.z > 0.0 ? pdfSpecular(vec2(c.alpha), o, i) : 0.0;
}
