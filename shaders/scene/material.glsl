// Materials as BSDF parameters.
// Based on: glTF 2.0 appendix B; KHR_materials_specular; KHR_materials_ior; KHR_materials_emissive_strength;
// KHR_materials_transmission; KHR_materials_volume (as the mark of a solid).
#include "lib/bsdf.glsl"
#include "scene/albedo_table.glsl"
#include "scene/material_record.glsl"
#include "shared/scene.h"

// Radiance that the material sends to a side of the triangle.
vec3 emissionOf(MaterialRecord material, bool isFront) {
    return isFront || (material.flags & kMaterialDoubleSided) != 0u ? material.emission : vec3(0.0);
}

// isFront: wo is on the triangle's front, which is the outside of a solid.
Glass glassOf(MaterialRecord material, bool isFront) {
    Glass glass;
    glass.color = material.baseColor;
    glass.alpha = material.roughness * material.roughness;
    glass.isThin = (material.flags & kMaterialSolid) == 0u;
    glass.eta = isFront || glass.isThin ? material.ior : 1.0 / material.ior;
    return glass;
}

Surface surfaceOf(MaterialRecord material, bool isFront) {
    const float r = (material.ior - 1.0) / (material.ior + 1.0);
    const vec3 dielectricF0 = min(r * r * material.specularColor, vec3(1.0)) * material.specular;
    const float dielectric = 1.0 - material.metallic;
    const float opaque = dielectric * (1.0 - material.transmission);
    Surface s;
    s.diffuse = opaque * material.baseColor;
    s.f0 = opaque * dielectricF0 + material.metallic * material.baseColor;
    s.f90 = opaque * material.specular + material.metallic;
    s.alpha = material.roughness * material.roughness;
    s.coating = vec2(max(dielectricF0.x, max(dielectricF0.y, dielectricF0.z)), material.specular);
    s.glassShare = dielectric * material.transmission;
    s.glass = glassOf(material, isFront);
    return s;
}
