// The BSDF: glTF's metallic-roughness surface and the layers of its extensions (lib/bsdf/surface.glsl) as a mixture of lobes.
// Based on: glTF 2.0 appendix B, KHR_materials_specular, _transmission, _volume, _anisotropy, _clearcoat, _sheen,
// _iridescence, _diffuse_transmission, with one change: layers are coupled by directional albedo (lib/bsdf/layers.glsl),
// since appendix B's (1 - F(V.H)) makes a white dielectric reflect more than it receives at grazing angles.
//
// Contract
//   basis      local, z = shading normal on the side of wo, x = direction of larger roughness; unit directions
//   wo         towards the previous vertex, wo.z > 0 (else everything is zero)
//   wi         the other direction; wi.z < 0 lies behind the surface, where only glass and diffuse transmission send light
//   evalBsdf   f(wo, wi) * |wi.z|, without delta lobes
//   pdfBsdf    per solid angle, of what sampleBsdf draws, without delta lobes
//   sampleBsdf wi, weight = f |cos| / pdf, pdf (0 for a delta lobe), eta; weight 0 means absorbed
#include "lib/bsdf/choice.glsl"

struct BsdfSample {
    vec3 wi;
    vec3 weight;
    float pdf;
    float eta; // relative index of refraction that the direction passed into; 1: stayed
};

// The base without the layers above it.
vec3 evalBase(Surface s, vec3 wo, vec3 wi) {
    vec3 value = vec3(0.0);
    if (wi.z > 0.0 && s.diffuse != vec3(0.0))
        value = evalDiffuse(s.diffuse, wi) * coupling(s, wo, wi);
    if (wi.z < 0.0 && hasThrough(s))
        value = evalDiffuseTransmission(s.through, wi) * coupling(s, wo, wi);
    if (isSmooth(s))
        return value;
    if (wi.z > 0.0 && hasSpecular(s))
        value += evalSpecular(s.specular, wo, wi);
    if (wi.z > 0.0 && hasMultiple(s))
        value += evalMultipleScattering(s.multiple, wi, maskingLoss(s, wo), maskingLoss(s, wi),
                                        averageMaskingLoss(s.specular.alpha));
    if (hasGlass(s))
        value += s.glassShare * evalGlass(s.glass, wo, wi);
    return value;
}

vec3 evalBsdf(Surface s, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z == 0.0)
        return vec3(0.0);
    vec3 value = evalBase(s, wo, wi);
    if (hasSheen(s)) {
        value *= throughSheen(s, wo.z, abs(wi.z));
        value += wi.z > 0.0 ? evalSheen(s.sheen, wo, wi) : vec3(0.0);
    }
    if (hasClearcoat(s)) {
        value *= throughClearcoat(s, wo, wi);
        value += wi.z > 0.0 && !isSmoothClearcoat(s) ? evalClearcoat(s.clearcoat, wo, wi) : 0.0;
    }
    return value;
}

float pdfBsdf(Surface s, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z == 0.0)
        return 0.0;
    const LobeProbabilities p = lobeProbabilities(s, wo);
    float pdf = wi.z > 0.0 ? p.diffuse * pdfDiffuse(wi) : 0.0;
    if (sceneHas(kFeatureDiffuseTransmission) && wi.z < 0.0)
        pdf = p.through * pdfDiffuseTransmission(wi);
    if (sceneHas(kFeatureSheen) && wi.z > 0.0)
        pdf += p.sheen * pdfSheen(wi);
    if (hasClearcoat(s) && wi.z > 0.0 && !isSmoothClearcoat(s))
        pdf += p.clearcoat * pdfClearcoat(s.clearcoat, wo, wi);
    if (isSmooth(s))
        return pdf;
    if (sceneHas(kFeatureSpecular) && p.specular > 0.0 && wi.z > 0.0)
        pdf += p.specular * pdfSpecular(s.specular.alpha, wo, wi);
    if (sceneHas(kFeatureGlass) && p.glass > 0.0)
        pdf += p.glass * pdfGlass(s.glass, wo, wi);
    return pdf;
}

const BsdfSample kAbsorbed = BsdfSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, 1.0);

// A mirror, a pane or a varnish: the one direction of a smooth lobe, or one of two. A bent coat normal may send it below.
BsdfSample sampleSmooth(Surface s, vec3 wo, LobeChoice choice) {
    vec3 wi = vec3(-wo.xy, wo.z);
    if (sceneHas(kFeatureClearcoat) && choice.lobe == kLobeClearcoat) {
        const float cosTheta = dot(wo, s.clearcoat.normal);
        wi = 2.0 * cosTheta * s.clearcoat.normal - wo;
        const float f = cosTheta > 0.0 && wi.z > 0.0 ? clearcoatFresnel(cosTheta) : 0.0;
        return BsdfSample(wi, vec3(s.clearcoat.weight * f / choice.probability), 0.0, 1.0);
    }
    vec3 weight = specularFresnel(s.specular, wo.z);
    if (sceneHas(kFeatureGlass) && choice.lobe == kLobeGlass) {
        wi = sampleGlass(s.glass, wo, vec2(0.0), choice.rest);
        weight = s.glassShare * smoothGlassWeight(s.glass, wo, wi);
    }
    weight *= throughSheen(s, wo.z, abs(wi.z)) * throughClearcoat(s, wo, wi) / choice.probability;
    return BsdfSample(wi, weight, 0.0, wi.z < 0.0 && !s.glass.isThin ? s.glass.eta : 1.0);
}

bool isSmoothLobe(Surface s, uint lobe) {
    if (sceneHas(kFeatureClearcoat) && lobe == kLobeClearcoat)
        return isSmoothClearcoat(s);
    return isSmooth(s) && (lobe == kLobeSpecular || lobe == kLobeGlass);
}

// Direction drawn from the lobe that was chosen, which must not be smooth.
vec3 sampleLobe(Surface s, vec3 wo, vec2 u, LobeChoice choice) {
    vec3 wi = sampleDiffuse(u);
    if (sceneHas(kFeatureDiffuseTransmission) && choice.lobe == kLobeThrough)
        wi = sampleDiffuseTransmission(u);
    if (sceneHas(kFeatureSheen) && choice.lobe == kLobeSheen)
        wi = sampleSheen(u);
    if (sceneHas(kFeatureClearcoat) && sceneHas(kFeatureRoughLobes) && choice.lobe == kLobeClearcoat)
        wi = sampleClearcoat(s.clearcoat, u, wo);
    if (sceneHas(kFeatureGlass) && sceneHas(kFeatureRoughLobes) && choice.lobe == kLobeGlass)
        wi = sampleGlass(s.glass, wo, u, choice.rest);
    if (sceneHas(kFeatureSpecular) && sceneHas(kFeatureRoughLobes) && choice.lobe == kLobeSpecular)
        wi = sampleSpecular(u, wo, s.specular.alpha);
    return wi;
}

// What the glass lobe draws where it is too narrow for a density.
BsdfSample narrowSample(Surface s, vec3 wo, vec3 wi, vec2 u, LobeChoice choice) {
    if (wi == vec3(0.0))
        return kAbsorbed;
    const vec3 weight = s.glassShare * narrowGlassWeight(s.glass, wo, u, wi) * throughSheen(s, wo.z, abs(wi.z)) *
                        throughClearcoat(s, wo, wi) / choice.probability;
    return BsdfSample(wi, weight, 0.0, wi.z < 0.0 && !s.glass.isThin ? s.glass.eta : 1.0);
}

// u: direction; lobe: which lobe, and within glass which side.
BsdfSample sampleBsdf(Surface s, vec3 wo, vec2 u, float lobe) {
    if (wo.z <= 0.0)
        return kAbsorbed;
    const LobeChoice choice = chooseLobe(lobeProbabilities(s, wo), lobe);
    if (sceneHas(kFeatureSmoothLobes) && isSmoothLobe(s, choice.lobe))
        return sampleSmooth(s, wo, choice);
    const vec3 wi = sampleLobe(s, wo, u, choice);
    if (sceneHas(kFeatureGlass) && sceneHas(kFeatureRoughLobes) && choice.lobe == kLobeGlass && isDeltaGlass(s.glass, wi))
        return narrowSample(s, wo, wi, u, choice);
    const float pdf = pdfBsdf(s, wo, wi);
    if (pdf <= 0.0)
        return kAbsorbed;
    const bool entersGlass = hasGlass(s) && wi.z < 0.0 && !s.glass.isThin;
    return BsdfSample(wi, evalBsdf(s, wo, wi) / pdf, pdf, entersGlass ? s.glass.eta : 1.0);
}
