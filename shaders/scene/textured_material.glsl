// What textures and vertex colours make of a material at a point: from here on there are only numbers.
// Based on: glTF 2.0, section 3.9, and the extensions that name the slots, for the channels that each reads.
#include "lib/features.glsl"
#include "lib/bsdf/normal_map.glsl"
#include "lib/sampling/sampler.glsl"
#include "scene/interaction.glsl"
#include "scene/material_record.glsl"
#include "scene/texture.glsl"
#include "scene/vertex_color.glsl"

void applyBaseTexel(uint slot, vec4 texel, inout MaterialRecord m) {
    if (slot == kSlotBaseColor)
        m.baseColor *= texel.rgb;
    if (slot == kSlotMetallicRoughness) {
        m.metallic *= texel.b;
        m.roughness *= texel.g;
    }
    if (slot == kSlotEmission)
        m.emission *= texel.rgb;
    if (slot == kSlotSpecular)
        m.specular *= texel.a;
    if (slot == kSlotSpecularColor) {
        m.specularColor *= texel.rgb;
        if ((m.flags & kMaterialGlossiness) != 0u)
            m.roughness = 1.0 - (1.0 - m.roughness) * texel.a;
    }
    if (sceneHas(kFeatureGlass) && slot == kSlotTransmission)
        m.transmission *= texel.r;
}

void applyLayerTexel(uint slot, vec4 texel, inout MaterialRecord m) {
    if (sceneHas(kFeatureClearcoat) && slot == kSlotClearcoat)
        m.clearcoat *= texel.r;
    if (sceneHas(kFeatureClearcoat) && slot == kSlotClearcoatRoughness)
        m.clearcoatRoughness *= texel.g;
    if (sceneHas(kFeatureSheen) && slot == kSlotSheenColor)
        m.sheenColor *= texel.rgb;
    if (sceneHas(kFeatureSheen) && slot == kSlotSheenRoughness)
        m.sheenRoughness *= texel.a;
    if (sceneHas(kFeatureIridescence) && slot == kSlotIridescence)
        m.iridescence *= texel.r;
    if (sceneHas(kFeatureIridescence) && slot == kSlotIridescenceThickness)
        m.iridescenceThicknessMaximum = mix(m.iridescenceThicknessMinimum, m.iridescenceThicknessMaximum, texel.g);
    if (sceneHas(kFeatureDiffuseTransmission) && slot == kSlotDiffuseTransmission)
        m.diffuseTransmission *= texel.a;
    if (sceneHas(kFeatureDiffuseTransmission) && slot == kSlotDiffuseTransmissionColor)
        m.diffuseTransmissionColor *= texel.rgb;
}

// The normal of the clear coat by the texel of its normal texture. wo: unit vector back along the ray.
vec3 coatNormalBy(vec4 texel, vec3 wo, MaterialRecord m, Interaction i) {
    Basis basis = Basis(i.tangent, i.bitangent, i.meshNormal);
    if (sceneHas(kFeatureTangentPlanes))
        basis = textureBasis(i, m.coatTangents);
    return bentNormal(mappedNormal(basis, texel.xyz, m.clearcoatNormalScale), i.ng, wo);
}

// What changes the basis of shading. wo: unit vector back along the ray.
void applyBasisTexel(uint slot, vec4 texel, vec3 wo, inout MaterialRecord m, inout Interaction i) {
    if (slot == kSlotNormal)
        i.n = bentNormal(mappedNormal(Basis(i.tangent, i.bitangent, i.meshNormal), texel.xyz, m.normalScale), i.ng, wo);
    if (sceneHas(kFeatureClearcoat) && slot == kSlotClearcoatNormal)
        i.coatNormal = coatNormalBy(texel, wo, m, i);
    if (sceneHas(kFeatureAnisotropy) && slot == kSlotAnisotropy) {
        m.anisotropy *= texel.b;
        i.anisotropyDirection = 2.0 * texel.rg - 1.0;
        if (sceneHas(kFeatureTangentPlanes)) // slots come in order: normal maps have had theirs
            setTangents(m.anisotropyTangents, i);
    }
}

// The material's members at the point, with textures and vertex colours multiplied in; iridescenceThicknessMaximum
// becomes the thickness there. Normals of the interaction follow normal maps. One turn of the loop for each texture
// that there is: lavapipe executes both sides of an `if`, and only loops skip work. All textures draw their texel by the
// same numbers, so that where they are of one size the material is that of one texel.
MaterialRecord texturedMaterial(MaterialRecord m, vec3 wo, SampleKey key, inout Interaction i) {
    if (sceneHas(kFeatureVertexColors))
        m.baseColor *= vertexColor(i.id, i.b).rgb;
    if (!sceneHas(kFeatureTextures))
        return m; // a loop of no rounds is not removed by every driver, and runs once with all lanes masked
    const vec2 u = kTextureFilter == kTextureFilterStochastic ? sample2D(key, kDimensionTexel) : vec2(0.0);
    uint index = m.firstTexture;
    for (uint slots = m.textureSlots; slots != 0u; slots &= slots - 1u) {
        const uint slot = uint(findLSB(slots));
        const vec4 texel = textureAt(index, i.id, i.b, u);
        applyBaseTexel(slot, texel, m);
        applyLayerTexel(slot, texel, m);
        if (sceneHas(kFeatureTangents))
            applyBasisTexel(slot, texel, wo, m, i);
        ++index;
    }
    return m;
}
