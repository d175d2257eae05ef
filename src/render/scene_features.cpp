#include "render/scene_features.h"

#include "shared/scene.h"

namespace lavalight {
namespace {

uint32_t featuresOf(const Material& material) {
    const bool isSpecular = material.metallic > 0.0f || material.specular > 0.0f;
    const bool isGlass = material.metallic < 1.0f && material.transmission > 0.0f;
    uint32_t features = (isSpecular ? kFeatureSpecular : 0u) | (isGlass ? kFeatureGlass : 0u);
    if (features != 0)
        features |=
            material.roughness * material.roughness < kSmoothAlpha ? kFeatureSmoothLobes : kFeatureRoughLobes;
    return features;
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
    if (lights.environment)
        features |= lights.environmentMap ? kFeatureEnvironmentMap : kFeatureEnvironment;
    features |= lights.tree.nodes.empty() ? 0u : kFeatureLightTree;
    return features;
}

uint32_t cameraFeatures(const Camera& camera) {
    const bool isSpecial = camera.projection == Projection::panorama || camera.lensRadius > 0.0f;
    return isSpecial ? kFeatureSpecialCamera : 0u;
}

} // namespace lavalight
