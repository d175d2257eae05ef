#include "render/scene_features.h"

#include <algorithm>
#include <vector>

#include "render/gpu_textures.h"
#include "scene/coverage.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

bool has(const Material& material, TextureSlot slot) {
    return material.texture(slot).has_value();
}

// Of its specular and glass lobes. Textures make metals of nothing and nothing of metals, but a mirror never
// rougher, nor what is rough without a texture smoother.
uint32_t lobesOf(const Material& material) {
    const bool isMetal = material.metallic >= 1.0f && !has(material, TextureSlot::metallicRoughness);
    const bool isSpecular = material.metallic > 0.0f || material.specular > 0.0f;
    const bool isGlass = !isMetal && material.transmission > 0.0f;
    if (!isSpecular && !isGlass)
        return 0;
    const bool isSmooth = material.roughness * material.roughness < kSmoothAlpha;
    const bool isGlossiness = material.isGlossiness && has(material, TextureSlot::specularColor);
    const bool mayBeSmooth = isSmooth || has(material, TextureSlot::metallicRoughness);
    const bool mayBeRough = !isSmooth || isGlossiness;
    return (isSpecular ? kFeatureSpecular : 0u) | (isGlass ? kFeatureGlass : 0u) |
           (mayBeSmooth ? kFeatureSmoothLobes : 0u) | (mayBeRough ? kFeatureRoughLobes : 0u);
}

bool attenuates(const Material& material) {
    return material.isSolid && material.attenuationDistance < kNoAttenuation &&
           material.attenuationColor != glm::vec3(1.0f);
}

bool wantsTangents(const Material& material) {
    return has(material, TextureSlot::normal) || has(material, TextureSlot::clearcoatNormal) ||
           material.anisotropy > 0.0f;
}

uint32_t featuresOf(const Material& material) {
    uint32_t features = lobesOf(material);
    features |= textureSlots(material) != 0 ? kFeatureTextures : 0u;
    features |= wantsTangents(material) ? kFeatureTangents : 0u;
    features |= material.isUnlit ? kFeatureUnlit : 0u;
    features |= attenuates(material) ? kFeatureAttenuation : 0u;
    return features;
}

uint32_t featuresOf(const Mesh& mesh) {
    return (mesh.normals.empty() ? 0u : kFeatureShadingNormals) |
           (mesh.colors.empty() ? 0u : kFeatureVertexColors);
}

} // namespace

uint32_t sceneFeatures(const Scene& scene, const Lights& lights) {
    uint32_t features = 0;
    for (const Material& material : scene.materials)
        features |= featuresOf(material);
    for (const Mesh& mesh : scene.meshes)
        features |= featuresOf(mesh);
    const std::vector<bool> transparent = transparentMeshes(scene);
    features |=
        std::find(transparent.begin(), transparent.end(), true) != transparent.end() ? kFeatureAlpha : 0u;
    features |= lights.emitters.list.empty() ? 0u : kFeatureTriangleLights;
    features |= lights.punctuals.empty() ? 0u : kFeaturePunctualLights;
    features |= lights.environment ? kFeatureEnvironment : 0u;
    features |= lights.tree.nodes.empty() ? 0u : kFeatureLightTree;
    return features;
}

} // namespace lavalight
