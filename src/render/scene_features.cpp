#include "render/scene_features.h"

#include "shared/scene.h"

namespace lavalight {
namespace {

uint32_t lobeOf(float roughness) {
    return roughness * roughness < kSmoothAlpha ? kFeatureSmoothLobes : kFeatureRoughLobes;
}

// Of the layers and lobes that extensions add.
uint32_t extendedFeaturesOf(const Material& material) {
    const bool isGlass = material.metallic < 1.0f && material.transmission > 0.0f;
    uint32_t features =
        material.clearcoat > 0.0f ? kFeatureClearcoat | lobeOf(material.clearcoatRoughness) : 0u;
    features |= material.sheenColor != glm::vec3(0.0f) ? kFeatureSheen : 0u;
    features |= material.anisotropy > 0.0f ? kFeatureAnisotropy | kFeatureRoughLobes : 0u;
    features |= material.iridescence > 0.0f ? kFeatureIridescence : 0u;
    features |= material.diffuseTransmission > 0.0f ? kFeatureDiffuseTransmission : 0u;
    features |= isGlass && material.isSolid && material.dispersion > 0.0f ? kFeatureDispersion : 0u;
    return features;
}

uint32_t featuresOf(const Material& material) {
    const bool isSpecular = material.metallic > 0.0f || material.specular > 0.0f;
    const bool isGlass = material.metallic < 1.0f && material.transmission > 0.0f;
    uint32_t features = (isSpecular ? kFeatureSpecular : 0u) | (isGlass ? kFeatureGlass : 0u);
    if (features != 0)
        features |= lobeOf(material.roughness);
    return features | extendedFeaturesOf(material);
}

} // namespace

uint32_t sceneFeatures(const Scene& scene, const Lights& lights) {
    uint32_t features = 0;
    for (const Material& material : scene.materials)
        features |= featuresOf(material);
    for (const Mesh& mesh : scene.meshes)
        features |= mesh.normals.empty() ? 0u : kFeatureShadingNormals;
    features |= lights.emitters.list.empty() ? 0u : kFeatureTriangleLights;
    features |= lights.punctuals.empty() ? 0u : kFeaturePunctualLights;
    features |= lights.environment ? kFeatureEnvironment : 0u;
    features |= lights.tree.nodes.empty() ? 0u : kFeatureLightTree;
    return features;
}

} // namespace lavalight
