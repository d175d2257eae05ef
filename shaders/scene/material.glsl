// Materials as BSDF parameters.
// Based on: glTF 2.0 appendix B; KHR_materials_specular; KHR_materials_ior; KHR_materials_emissive_strength;
// KHR_materials_transmission; KHR_materials_volume (as the mark of a solid); KHR_materials_anisotropy, _clearcoat, _sheen,
// _iridescence, _diffuse_transmission.
#include "lib/bsdf/bsdf.glsl"
#include "scene/albedo_table.glsl"
#include "scene/material_record.glsl"
#include "shared/scene.h"

// Radiance that the material sends to a side of the triangle.
vec3 emissionOf(MaterialRecord material, bool isFront) {
    return isFront || (material.flags & kMaterialDoubleSided) != 0u ? material.emission : vec3(0.0);
}

Film filmOf(MaterialRecord material) {
    return Film(material.iridescence, material.iridescenceIor, material.iridescenceThicknessMaximum);
}

// KHR_materials_anisotropy: rougher along the tangent. Both alphas are clear of smoothness or neither is.
vec2 alphaOf(MaterialRecord material) {
    const float alpha = material.roughness * material.roughness;
    if (!sceneHas(kFeatureAnisotropy) || material.anisotropy == 0.0)
        return vec2(alpha);
    const float along = mix(alpha, 1.0, material.anisotropy * material.anisotropy);
    return vec2(along, along < kSmoothAlpha ? along : max(alpha, kSmoothAlpha));
}

// isFront: wo is on the triangle's front, which is the outside of a solid.
Glass glassOf(MaterialRecord material, bool isFront) {
    const bool isThin = (material.flags & kMaterialSolid) == 0u;
    const bool enters = isFront || isThin;
    const float eta = relativeIndex(enters ? material.ior : 1.0, enters ? 1.0 : material.ior);
    return makeGlass(material.baseColor, alphaOf(material), eta, isThin, filmOf(material));
}

// What covers the diffuse base: the dielectric alone, largest channel. Under a film, whose colours mix dielectric and
// metal, a bound on all that the specular lobe reflects.
vec2 coatingOf(MaterialRecord material, vec3 dielectricF0, Specular specular) {
    const vec2 plain = vec2(largestOf(dielectricF0), material.specular);
    const float opaque = 1.0 - (1.0 - material.metallic) * material.transmission;
    if (!sceneHas(kFeatureIridescence) || specular.film.weight <= 0.0 || opaque <= 0.0)
        return plain;
    const FilmBound bound = filmBound(specular.film, specular.f0 / max(specular.f90, 1e-6));
    const vec2 film = specular.f90 * vec2(largestOf(bound.f0), largestOf(bound.f90));
    return mix(vec2(largestOf(specular.f0), specular.f90), film, specular.film.weight) / opaque;
}

// isFront: wo is on the triangle's front. The basis' x axis is the direction of anisotropy.
Surface surfaceOf(MaterialRecord material, bool isFront) {
    const float r = (material.ior - 1.0) / (material.ior + 1.0);
    const vec3 dielectricF0 = min(r * r * material.specularColor, vec3(1.0)) * material.specular;
    const float dielectric = 1.0 - material.metallic;
    const float opaque = dielectric * (1.0 - material.transmission);
    Surface s;
    s.diffuse = opaque * (1.0 - material.diffuseTransmission) * material.baseColor;
    s.through = opaque * material.diffuseTransmission * material.diffuseTransmissionColor;
    s.specular.f0 = opaque * dielectricF0 + material.metallic * material.baseColor;
    s.specular.f90 = opaque * material.specular + material.metallic;
    s.specular.alpha = alphaOf(material);
    s.specular.film = filmOf(material);
    s.multiple = vec3(0.0);
    if (sceneHas(kFeatureSpecular) && kMultipleScattering != 0u && !isSmooth(s))
        s.multiple = material.metallic *
                     multipleScatteringColor(material.baseColor, averageMaskingLoss(s.specular.alpha));
    s.coating = coatingOf(material, dielectricF0, s.specular);
    s.glassShare = dielectric * material.transmission;
    s.glass = glassOf(material, isFront);
    s.clearcoat = Clearcoat(material.clearcoat, material.clearcoatRoughness * material.clearcoatRoughness,
                            vec3(0.0, 0.0, 1.0));
    const float sheenRoughness = max(material.sheenRoughness, kLeastSheenRoughness);
    s.sheen = Sheen(material.sheenColor, sheenRoughness * sheenRoughness);
    return s;
}
