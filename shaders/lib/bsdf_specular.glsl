// GGX reflection lobe with Schlick's Fresnel: sample, eval, pdf. Rough only; the smooth case is a delta in bsdf.glsl.
#include "lib/fresnel.glsl"
#include "lib/microfacet.glsl"

// wi below the horizon (wi.z <= 0) means that the sample is lost to masking.
vec3 sampleSpecular(vec2 u, vec3 wo, float alpha) {
    return reflect(-wo, squareToVisibleNormal(u, wo, alpha));
}

// f * |cos|; Walter 2007, eq. 20, with |cos| cancelled against 1 / |wi.z|.
vec3 evalSpecular(vec3 f0, float f90, float alpha, vec3 wo, vec3 wi) {
    const vec3 m = normalize(wo + wi);
    const float d = ggxD(m, alpha) * ggxG2(wo, wi, alpha) / (4.0 * wo.z);
    return schlick(f0, f90, dot(wo, m)) * d;
}

float pdfSpecular(float alpha, vec3 wo, vec3 wi) {
    const vec3 m = normalize(wo + wi);
    return squareToVisibleNormalPdf(m, wo, alpha) / (4.0 * max(dot(wo, m), 1e-20));
}
