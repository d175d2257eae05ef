// GGX reflection lobe with Schlick's Fresnel, or that of a thin film: sample, eval, pdf. Rough only; the smooth case is a
// delta in bsdf.glsl.
#include "lib/features.glsl"
#include "lib/bsdf/fresnel.glsl"
#include "lib/bsdf/microfacet.glsl"
#include "lib/bsdf/thin_film.glsl"

struct Specular {
    vec3 f0; // F0 of the mix of dielectric and metal
    float f90;
    vec2 alpha; // roughness^2 along x and y; y is the smaller one
    Film film;
};

vec3 specularFresnel(Specular s, float cosTheta) {
    const vec3 plain = schlick(s.f0, s.f90, cosTheta);
    if (!sceneHas(kFeatureIridescence) || s.film.weight <= 0.0)
        return plain;
    return mix(plain, s.f90 * filmReflectance(s.film, s.f0 / max(s.f90, 1e-6), cosTheta), s.film.weight);
}

// Draws wi; 0 if it is lost to masking, below the horizon.
vec3 sampleSpecular(vec2 u, vec3 wo, vec2 alpha) {
    const vec3 wi = reflect(-wo, squareToVisibleNormal(u, wo, alpha));
    return wi.z > 0.0 ? wi : vec3(0.0);
}

// f * |cos| of mirrors as facets, m halfway between the directions; Walter 2007, eq. 20, with |cos| cancelled against
// 1 / |wi.z|.
float evalFacets(vec2 alpha, vec3 wo, vec3 wi, vec3 m) {
    return ggxD(m, alpha) * ggxG2(wo, wi, alpha) / (4.0 * wo.z);
}

vec3 evalSpecular(Specular s, vec3 wo, vec3 wi) {
    const vec3 m = normalize(wo + wi);
    return specularFresnel(s, dot(wo, m)) * evalFacets(s.alpha, wo, wi, m);
}

float pdfSpecular(vec2 alpha, vec3 wo, vec3 wi) {
    const vec3 m = normalize(wo + wi);
    return squareToVisibleNormalPdf(m, wo, alpha) / (4.0 * max(dot(wo, m), 1e-20));
}
