// The BSDF: glTF's metallic-roughness surface as a mixture of a diffuse, a specular and a glass lobe.
// Based on: glTF 2.0 appendix B, KHR_materials_specular, KHR_materials_transmission, KHR_materials_volume, with one change:
// diffuse and specular are coupled by directional albedo (Kelemen, Szirmay-Kalos, "A Microfacet Based Coupled
// Specular-Matte BRDF Model", 2001), since appendix B's (1 - F(V.H)) makes a white dielectric reflect more than it receives
// at grazing angles.
//
// Contract
//   frame      local, z = shading normal on the side of wo; all directions have unit length
//   wo         towards the previous vertex, wo.z > 0 (else everything is zero)
//   wi         the other direction; wi.z < 0 lies behind the surface, where only glass sends light
//   evalBsdf   f(wo, wi) * |wi.z|, without delta lobes
//   pdfBsdf    per solid angle, of what sampleBsdf draws, without delta lobes
//   sampleBsdf wi, weight = f |cos| / pdf, pdf (0 for a delta lobe), eta; weight 0 means absorbed
#include "lib/bsdf_diffuse.glsl"
#include "lib/bsdf_glass.glsl"
#include "lib/bsdf_specular.glsl"
#include "lib/features.glsl"

// x, y: directional albedo of the GGX lobe is f0 * x + f90 * y at this cosine. From scene/albedo_table.glsl.
vec2 specularAlbedoTerms(float cosTheta, float alpha);
// The same, averaged over the hemisphere by the cosine.
vec2 specularAlbedoAverage(float alpha);

struct Surface {
    vec3 diffuse;     // albedo of the opaque base
    vec3 f0;          // of the mix of dielectric and metal
    float f90;
    float alpha;      // roughness^2
    vec2 coating;     // f0 and f90 of the dielectric alone (largest channel): what covers the diffuse base
    float glassShare; // weight of the glass lobe
    Glass glass;
};

struct BsdfSample {
    vec3 wi;
    vec3 weight;
    float pdf;
    float eta; // relative index of refraction that the direction passed into; 1: stayed
};

bool hasSpecular(Surface s) {
    return sceneHas(kFeatureSpecular) && (s.f90 > 0.0 || s.f0 != vec3(0.0));
}

bool hasGlass(Surface s) {
    return sceneHas(kFeatureGlass) && s.glassShare > 0.0;
}

// Of its specular and glass lobes, if there are any.
bool isSmooth(Surface s) {
    return !sceneHas(kFeatureRoughLobes) || (sceneHas(kFeatureSmoothLobes) && s.alpha < kSmoothAlpha);
}

// Whether there is anything for light sampling to find.
bool hasNonDelta(Surface s) {
    return s.diffuse != vec3(0.0) || (!isSmooth(s) && (hasSpecular(s) || hasGlass(s)));
}

// Share of light that the dielectric coating lets through to the diffuse base, (1 - E(wo)) (1 - E(wi)) / (1 - Eavg):
// reciprocal, and the base then reflects exactly (1 - E(wo)) * diffuse.
float coupling(Surface s, float cosO, float cosI) {
    if (!sceneHas(kFeatureSpecular) || s.coating.y <= 0.0)
        return 1.0;
    const float eo = dot(s.coating, specularAlbedoTerms(cosO, s.alpha));
    const float ei = dot(s.coating, specularAlbedoTerms(cosI, s.alpha));
    const float average = dot(s.coating, specularAlbedoAverage(s.alpha));
    return (1.0 - eo) * (1.0 - ei) / max(1.0 - average, 1e-4);
}

float meanOf(vec3 v) {
    return (v.x + v.y + v.z) * (1.0 / 3.0);
}

// Probabilities of drawing the specular (x) and the glass lobe (y), by their shares of the directional albedo.
vec2 lobeProbabilities(Surface s, vec3 wo) {
    if (!hasSpecular(s) && !hasGlass(s))
        return vec2(0.0);
    const vec2 terms = specularAlbedoTerms(wo.z, s.alpha);
    const float specular = meanOf(s.f0) * terms.x + s.f90 * terms.y;
    const float diffuse = meanOf(s.diffuse) * (1.0 - dot(s.coating, terms));
    return vec2(specular, s.glassShare) / max(specular + diffuse + s.glassShare, 1e-20);
}

// What roulette by albedo goes by: base colour for Lambert, F0 for metal, 1 for glass, the tabulated albedo for layers.
vec3 directionalAlbedo(Surface s, vec3 wo) {
    if (!sceneHas(kFeatureSpecular) || s.coating.y <= 0.0)
        return s.diffuse + s.f0 + s.glassShare;
    const vec2 terms = specularAlbedoTerms(wo.z, s.alpha);
    return s.diffuse * (1.0 - dot(s.coating, terms)) + s.f0 * terms.x + s.f90 * terms.y + s.glassShare;
}

vec3 evalBsdf(Surface s, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z == 0.0)
        return vec3(0.0);
    vec3 value = vec3(0.0);
    if (wi.z > 0.0 && s.diffuse != vec3(0.0))
        value = evalDiffuse(s.diffuse, wi) * coupling(s, wo.z, wi.z);
    if (isSmooth(s))
        return value;
    if (wi.z > 0.0 && hasSpecular(s))
        value += evalSpecular(s.f0, s.f90, s.alpha, wo, wi);
    if (hasGlass(s))
        value += s.glassShare * evalGlass(s.glass, wo, wi);
    return value;
}

float pdfBsdf(Surface s, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z == 0.0)
        return 0.0;
    const vec2 p = lobeProbabilities(s, wo);
    float pdf = wi.z > 0.0 ? (1.0 - p.x - p.y) * pdfDiffuse(wi) : 0.0;
    if (isSmooth(s))
        return pdf;
    if (sceneHas(kFeatureSpecular) && p.x > 0.0 && wi.z > 0.0)
        pdf += p.x * pdfSpecular(s.alpha, wo, wi);
    if (sceneHas(kFeatureGlass) && p.y > 0.0)
        pdf += p.y * pdfGlass(s.glass, wo, wi);
    return pdf;
}

const BsdfSample kAbsorbed = BsdfSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, 1.0);

// A mirror or a pane: the one direction of a smooth lobe that was drawn with probability p.
BsdfSample sampleSmooth(Surface s, vec3 wo, bool isGlass, float v, float p) {
    if (!isGlass)
        return BsdfSample(vec3(-wo.xy, wo.z), schlick(s.f0, s.f90, wo.z) / p, 0.0, 1.0);
    const vec3 wi = sampleGlass(s.glass, wo, vec2(0.0), v);
    const bool passes = wi.z < 0.0;
    const vec3 color = passes ? passColor(s.glass) : vec3(1.0);
    return BsdfSample(wi, s.glassShare * color / p, 0.0, passes && !s.glass.isThin ? s.glass.eta : 1.0);
}

// u: direction; lobe: which lobe, and within glass which side.
BsdfSample sampleBsdf(Surface s, vec3 wo, vec2 u, float lobe) {
    if (wo.z <= 0.0)
        return kAbsorbed;
    const vec2 p = lobeProbabilities(s, wo);
    const bool isGlass = sceneHas(kFeatureGlass) && lobe < p.y;
    const bool isSpecular = sceneHas(kFeatureSpecular) && !isGlass && lobe < p.x + p.y;
    if (sceneHas(kFeatureSmoothLobes) && isSmooth(s) && (isGlass || isSpecular))
        return sampleSmooth(s, wo, isGlass, lobe / max(p.y, 1e-20), isGlass ? p.y : p.x);
    vec3 wi = sampleDiffuse(u);
    if (sceneHas(kFeatureRoughLobes) && isGlass)
        wi = sampleGlass(s.glass, wo, u, lobe / p.y);
    if (sceneHas(kFeatureRoughLobes) && isSpecular)
        wi = sampleSpecular(u, wo, s.alpha);
    const float pdf = pdfBsdf(s, wo, wi);
    if (pdf <= 0.0)
        return kAbsorbed;
    return BsdfSample(wi, evalBsdf(s, wo, wi) / pdf, pdf, wi.z < 0.0 && !s.glass.isThin ? s.glass.eta : 1.0);
}
