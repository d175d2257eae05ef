// The BSDF: glTF's metallic-roughness surface as a mixture of a diffuse and a specular lobe.
// Based on: glTF 2.0 appendix B and KHR_materials_specular, with one change: diffuse and specular are coupled by
// directional albedo (Kelemen, Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model", 2001), since
// appendix B's (1 - F(V.H)) makes a white dielectric reflect more than it receives at grazing angles.
//
// Contract
//   frame      local, z = shading normal on the side of wo; all directions have unit length
//   wo         towards the previous vertex, wo.z > 0 (else everything is zero)
//   wi         the other direction; wi.z <= 0 is zero: these surfaces do not transmit
//   evalBsdf   f(wo, wi) * |wi.z|, without delta lobes
//   pdfBsdf    per solid angle, of what sampleBsdf draws, without delta lobes
//   sampleBsdf wi, weight = f |cos| / pdf, pdf (0 for a delta lobe); weight 0 means absorbed
#include "lib/bsdf_diffuse.glsl"
#include "lib/bsdf_specular.glsl"

// x, y: directional albedo of the GGX lobe is f0 * x + f90 * y at this cosine. From scene/albedo_table.glsl.
vec2 specularAlbedoTerms(float cosTheta, float alpha);
// The same, averaged over the hemisphere by the cosine.
vec2 specularAlbedoAverage(float alpha);

struct Surface {
    vec3 diffuse;  // albedo of the base, (1 - metallic) * baseColor
    vec3 f0;       // of the mix of dielectric and metal
    float f90;
    float alpha;   // roughness^2
    vec2 coating;  // f0 and f90 of the dielectric alone (largest channel): what covers the diffuse base
};

struct BsdfSample {
    vec3 wi;
    vec3 weight;
    float pdf;
};

bool hasSpecular(Surface s) {
    return s.f90 > 0.0 || s.f0 != vec3(0.0);
}

bool isSmooth(Surface s) {
    return s.alpha < kSmoothAlpha;
}

// Share of light that the dielectric coating lets through to the diffuse base, (1 - E(wo)) (1 - E(wi)) / (1 - Eavg):
// reciprocal, and the base then reflects exactly (1 - E(wo)) * diffuse.
float coupling(Surface s, float cosO, float cosI) {
    if (s.coating.y <= 0.0)
        return 1.0;
    const float eo = dot(s.coating, specularAlbedoTerms(cosO, s.alpha));
    const float ei = dot(s.coating, specularAlbedoTerms(cosI, s.alpha));
    const float average = dot(s.coating, specularAlbedoAverage(s.alpha));
    return (1.0 - eo) * (1.0 - ei) / max(1.0 - average, 1e-4);
}

float meanOf(vec3 v) {
    return (v.x + v.y + v.z) * (1.0 / 3.0);
}

// Probability of drawing the specular lobe: its share of the directional albedo.
float specularProbability(Surface s, vec3 wo) {
    if (!hasSpecular(s))
        return 0.0;
    const vec2 terms = specularAlbedoTerms(wo.z, s.alpha);
    const float specular = meanOf(s.f0) * terms.x + s.f90 * terms.y;
    const float diffuse = meanOf(s.diffuse) * (1.0 - dot(s.coating, terms));
    return specular / max(specular + diffuse, 1e-20);
}

vec3 evalBsdf(Surface s, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z <= 0.0)
        return vec3(0.0);
    vec3 value = vec3(0.0);
    if (s.diffuse != vec3(0.0))
        value = evalDiffuse(s.diffuse, wi) * coupling(s, wo.z, wi.z);
    if (hasSpecular(s) && !isSmooth(s))
        value += evalSpecular(s.f0, s.f90, s.alpha, wo, wi);
    return value;
}

float pdfBsdf(Surface s, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z <= 0.0)
        return 0.0;
    const float p = specularProbability(s, wo);
    float pdf = (1.0 - p) * pdfDiffuse(wi);
    if (p > 0.0 && !isSmooth(s))
        pdf += p * pdfSpecular(s.alpha, wo, wi);
    return pdf;
}

// u.xy: direction, u.z: lobe.
BsdfSample sampleBsdf(Surface s, vec3 wo, vec3 u) {
    const BsdfSample absorbed = BsdfSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0);
    if (wo.z <= 0.0)
        return absorbed;
    const float p = specularProbability(s, wo);
    vec3 wi;
    if (u.z < p) {
        if (isSmooth(s))
            return BsdfSample(vec3(-wo.xy, wo.z), schlick(s.f0, s.f90, wo.z) / p, 0.0);
        wi = sampleSpecular(u.xy, wo, s.alpha);
    } else {
        wi = sampleDiffuse(u.xy);
    }
    const float pdf = pdfBsdf(s, wo, wi);
    if (pdf <= 0.0)
        return absorbed;
    return BsdfSample(wi, evalBsdf(s, wo, wi) / pdf, pdf);
}
