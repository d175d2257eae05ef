// Materials as BSDF parameters.
// Based on: glTF 2.0 appendix B; KHR_materials_specular; KHR_materials_ior; KHR_materials_emissive_strength;
// KHR_materials_transmission; KHR_materials_volume (as the mark of a solid).
#include "lib/bsdf.glsl"
#include "scene/albedo_table.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"

layout(set = 0, binding = BINDING_MATERIALS) uniform usamplerBuffer materials;

uvec4 materialTexel(uint index, uint texel) {
    return texelFetch(materials, int(kMaterialTexels * index + texel));
}

// Members that no feature of the scene asks for are 0.
MaterialRecord fetchMaterial(uint index) {
    const uvec4 a = materialTexel(index, 0u);
    const uvec4 b = materialTexel(index, 1u);
    const uvec4 c = materialTexel(index, 2u);
    const uvec4 d = materialTexel(index, 3u);
    const uvec4 e = sceneHas(kFeatureTextures | kFeatureAlpha) ? materialTexel(index, 4u) : uvec4(0u);
    const uvec4 f = sceneHas(kFeatureAttenuation | kFeatureDispersion) ? materialTexel(index, 5u) : uvec4(0u);
    const uvec4 g = sceneHas(kFeatureClearcoat | kFeatureAnisotropy) ? materialTexel(index, 6u) : uvec4(0u);
    const uvec4 h = sceneHas(kFeatureSheen) ? materialTexel(index, 7u) : uvec4(0u);
    const uvec4 i = sceneHas(kFeatureAnisotropy | kFeatureIridescence) ? materialTexel(index, 8u) : uvec4(0u);
    const uvec4 j =
        sceneHas(kFeatureIridescence | kFeatureDiffuseTransmission) ? materialTexel(index, 9u) : uvec4(0u);
    const uvec4 k = sceneHas(kFeatureDiffuseTransmission) ? materialTexel(index, 10u) : uvec4(0u);
    return MaterialRecord(
        uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
        uintBitsToFloat(c.xyz), uintBitsToFloat(c.w), uintBitsToFloat(d.x), uintBitsToFloat(d.y), d.z, d.w, e.x,
        uintBitsToFloat(e.y), uintBitsToFloat(e.z), uintBitsToFloat(e.w), uintBitsToFloat(f.xyz),
        uintBitsToFloat(f.w), uintBitsToFloat(g.x), uintBitsToFloat(g.y), uintBitsToFloat(g.z),
        uintBitsToFloat(g.w), uintBitsToFloat(h.xyz), uintBitsToFloat(h.w), uintBitsToFloat(i.x),
        uintBitsToFloat(i.y), uintBitsToFloat(i.z), uintBitsToFloat(i.w), uintBitsToFloat(j.x),
        uintBitsToFloat(j.y), float[2](uintBitsToFloat(j.z), uintBitsToFloat(j.w)), uintBitsToFloat(k.xyz),
        uintBitsToFloat(k.w));
}

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
