// Materials as BSDF parameters.
// Based on: glTF 2.0 appendix B; KHR_materials_specular; KHR_materials_ior; KHR_materials_emissive_strength.
#include "lib/bsdf.glsl"
#include "scene/albedo_table.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"

layout(set = 0, binding = BINDING_MATERIALS) uniform usamplerBuffer materials;

MaterialRecord fetchMaterial(uint index) {
    const uvec4 a = texelFetch(materials, int(4u * index));
    const uvec4 b = texelFetch(materials, int(4u * index + 1u));
    const uvec4 c = texelFetch(materials, int(4u * index + 2u));
    const uvec4 d = texelFetch(materials, int(4u * index + 3u));
    return MaterialRecord(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz),
                          uintBitsToFloat(b.w), uintBitsToFloat(c.xyz), uintBitsToFloat(c.w),
                          uintBitsToFloat(d.x), d.y, 0u, 0u);
}

// Radiance that the material sends to a side of the triangle.
vec3 emissionOf(MaterialRecord material, bool isFront) {
    return isFront || material.doubleSided != 0u ? material.emission : vec3(0.0);
}

Surface surfaceOf(MaterialRecord material) {
    const float r = (material.ior - 1.0) / (material.ior + 1.0);
    const vec3 dielectricF0 = min(r * r * material.specularColor, vec3(1.0)) * material.specular;
    Surface s;
    s.diffuse = (1.0 - material.metallic) * material.baseColor;
    s.f0 = mix(dielectricF0, material.baseColor, material.metallic);
    s.f90 = mix(material.specular, 1.0, material.metallic);
    s.alpha = material.roughness * material.roughness;
    s.coating = vec2(max(dielectricF0.x, max(dielectricF0.y, dielectricF0.z)), material.specular);
    return s;
}
