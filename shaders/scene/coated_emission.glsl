// What a clearcoat lets through of the light that is emitted below it.
// Based on: KHR_materials_clearcoat, "Emission".
#include "lib/bsdf/clearcoat.glsl"
#include "scene/interaction.glsl"
#include "scene/textured_material.glsl"

// m: the material before its textures are multiplied in; wo: unit vector away from the surface. Hits and light samples ask
// this function alike, so that both find the same light: its textures are filtered even where the rest draws texels, since
// the mean of a product of drawn texels is not the product of their means.
float coatTransmittance(MaterialRecord m, vec3 wo, Interaction i) {
    float reflectance = 0.0;
    if (sceneHas(kFeatureCoatedLights)) {
        float weight = m.clearcoat;
        vec3 normal = i.coatNormal;
        if (sceneHas(kFeatureTextures) && hasTexture(m.textureSlots, kSlotClearcoat))
            weight *= textureAt(textureIndex(m.firstTexture, m.textureSlots, kSlotClearcoat), i.id, i.b).r;
        if (sceneHas(kFeatureTangents) && hasTexture(m.textureSlots, kSlotClearcoatNormal)) {
            const uint index = textureIndex(m.firstTexture, m.textureSlots, kSlotClearcoatNormal);
            normal = coatNormalBy(textureAt(index, i.id, i.b), wo, m, i);
        }
        reflectance = weight * clearcoatFresnel(abs(dot(normal, wo)));
    }
    return 1.0 - reflectance;
}
