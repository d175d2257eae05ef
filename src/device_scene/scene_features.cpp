#include "device_scene/scene_features.h"

#include <algorithm>
#include <vector>

#include "device_scene/gpu_textures.h"
#include "scene/coverage.h"
#include "scene/solids.h"
#include "shared/frame.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

// From where rays cost so much that the fused kernel gains by putting paths by
// (docs/performance.md).
constexpr uint64_t kManyTriangles = 10000;

bool has(const Material& material, TextureSlot slot) {
    return material.texture(slot).has_value();
}

// A texture makes a rough lobe smooth at some points; a smooth one it leaves
// smooth.
SceneFeatures lobeOf(float roughness, bool isTextured) {
    const bool isSmooth = roughness * roughness < kSmoothAlpha;
    return (isSmooth || isTextured ? kFeatureSmoothLobes : 0u) | (isSmooth ? 0u : kFeatureRoughLobes);
}

// Whether some point may be glass. A texture makes no metal of what is none, but other things of metals.
bool isGlass(const Material& material) {
    const bool isMetal = material.metallic >= 1.0f && !has(material, TextureSlot::metallicRoughness);
    return !isMetal && material.transmission > 0.0f;
}

// Features of the specular and the glass lobe.
SceneFeatures lobesOf(const Material& material) {
    const bool isSpecular = material.metallic > 0.0f || material.specular > 0.0f;
    if (!isSpecular && !isGlass(material))
        return 0;
    SceneFeatures features = (isSpecular ? kFeatureSpecular : 0u) | (isGlass(material) ? kFeatureGlass : 0u);
    features |= lobeOf(material.roughness, has(material, TextureSlot::metallicRoughness));
    if (material.isGlossiness && has(material, TextureSlot::specularColor))
        features |= kFeatureRoughLobes | kFeatureSmoothLobes;
    return features;
}

// Features of the layers and lobes that extensions add.
SceneFeatures extendedLobesOf(const Material& material) {
    SceneFeatures features = 0;
    if (material.clearcoat > 0.0f)
        features |= kFeatureClearcoat |
                    lobeOf(material.clearcoatRoughness, has(material, TextureSlot::clearcoatRoughness));
    features |= material.sheenColor != glm::vec3(0.0f) ? kFeatureSheen : 0u;
    features |= material.anisotropy > 0.0f ? kFeatureAnisotropy | kFeatureRoughLobes : 0u;
    features |= material.iridescence > 0.0f ? kFeatureIridescence : 0u;
    features |= material.diffuseTransmission > 0.0f ? kFeatureDiffuseTransmission : 0u;
    features |= isGlass(material) && material.isSolid && material.dispersion > 0.0f ? kFeatureDispersion : 0u;
    return features;
}

bool attenuates(const Material& material) {
    return boundsSolid(material) && material.attenuationDistance < kNoAttenuation &&
           material.attenuationColor != glm::vec3(1.0f);
}

bool wantsTangents(const Material& material) {
    return has(material, TextureSlot::normal) || has(material, TextureSlot::clearcoatNormal) ||
           material.anisotropy > 0.0f;
}

SceneFeatures featuresOf(const Material& material) {
    SceneFeatures features = lobesOf(material) | extendedLobesOf(material);
    const bool emits = material.emission != glm::vec3(0.0f) && !material.isUnlit;
    features |= emits ? kFeatureEmission : 0u;
    features |= emits && material.clearcoat > 0.0f ? kFeatureCoatedLights : 0u;
    features |= textureSlots(material) != 0 ? kFeatureTextures : 0u;
    features |= wantsTangents(material) ? kFeatureTangents : 0u;
    features |= material.isUnlit ? kFeatureUnlit : 0u;
    return features;
}

// Whether the extent along some axis comes near the offset by which rays start off surfaces: a bound on the
// rounding of coordinates (shaders/lib/math/ray_offset.glsl).
bool isThinForItsPlace(const Solid& solid) {
    constexpr float kOffset = 1e-6f; // of a coordinate
    const glm::vec3 extent = solid.bounds.upper - solid.bounds.lower;
    const glm::vec3 largest = glm::max(glm::abs(solid.bounds.lower), glm::abs(solid.bounds.upper));
    return std::min({extent.x, extent.y, extent.z}) <
           100.0f * kOffset * std::max({largest.x, largest.y, largest.z});
}

// Whether the bounds of any two have a point in common, or nearly.
bool anyTouch(const std::vector<Solid>& solids) {
    std::vector<Bounds> boxes;
    for (const Solid& solid : solids) {
        const glm::vec3 largest = glm::max(glm::abs(solid.bounds.lower), glm::abs(solid.bounds.upper));
        const float margin = 1e-5f * std::max({largest.x, largest.y, largest.z});
        boxes.push_back({solid.bounds.lower - margin, solid.bounds.upper + margin});
    }
    std::sort(boxes.begin(), boxes.end(),
              [](const Bounds& a, const Bounds& b) { return a.lower.x < b.lower.x; });
    for (size_t i = 0; i < boxes.size(); ++i)
        for (size_t j = i + 1; j < boxes.size() && boxes[j].lower.x < boxes[i].upper.x; ++j)
            if (glm::all(glm::lessThan(glm::max(boxes[i].lower, boxes[j].lower),
                                       glm::min(boxes[i].upper, boxes[j].upper))))
                return true;
    return false;
}

SceneFeatures featuresOf(const Mesh& mesh) {
    return (mesh.normals.empty() ? 0u : kFeatureShadingNormals) |
           (mesh.colors.empty() ? 0u : kFeatureVertexColors) |
           (mesh.furtherTangents.empty() ? 0u : kFeatureTangentPlanes);
}

SceneFeatures featuresOfPunctuals(const Scene& scene, const Lights& lights) {
    const auto& ids = lights.punctuals;
    const bool hasRange = std::any_of(ids.begin(), ids.end(),
                                      [&](uint32_t id) { return scene.punctualLights[id].range < kNoRange; });
    return (ids.empty() ? 0u : kFeaturePunctualLights) | (hasRange ? kFeatureLightRange : 0u);
}

} // namespace

bool wantsInteriorLists(const Scene& scene) {
    const auto fills = [&](const Solid& solid) {
        return attenuates(scene.materials[scene.meshes[solid.mesh].material]);
    };
    return std::any_of(scene.solids.begin(), scene.solids.end(), fills) ||
           std::any_of(scene.solids.begin(), scene.solids.end(), isThinForItsPlace) || anyTouch(scene.solids);
}

std::vector<SceneFeatures> surfaceFeatures(const Scene& scene) {
    std::vector<SceneFeatures> features(scene.materials.size(), 0);
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[mesh.material];
        features[mesh.material] |= featuresOf(material) | featuresOf(mesh);
        features[mesh.material] |= mesh.solid == 0 && attenuates(material) ? kFeatureAttenuation : 0u;
    }
    return features;
}

SceneFeatures sceneFeatures(const Scene& scene, const Lights& lights) {
    SceneFeatures features = 0;
    for (const SceneFeatures ofSurfaces : surfaceFeatures(scene))
        features |= ofSurfaces;
    const std::vector<bool> transparent = transparentMeshes(scene);
    features |=
        std::find(transparent.begin(), transparent.end(), true) != transparent.end() ? kFeatureAlpha : 0u;
    features |= scene.triangleCount() >= kManyTriangles ? kFeatureManyTriangles : 0u;
    features |= wantsInteriorLists(scene) ? kFeatureSolids : 0u;
    features |= lights.emitters.list.empty() ? 0u : kFeatureTriangleLights;
    features |= featuresOfPunctuals(scene, lights);
    if (lights.environmentRadiance != glm::vec3(0.0f))
        features |= lights.environmentMap ? kFeatureEnvironmentMap : kFeatureEnvironment;
    features |= lights.tree.nodes.empty() ? 0u : kFeatureLightTree;
    features |= lights.table.empty() ? 0u : kFeatureLights;
    features |= lights.environment ? kFeatureEnvironmentLight : 0u;
    features |= lights.sun ? kFeatureSun : 0u;
    return features;
}

SceneFeatures cameraFeatures(const Camera& camera) {
    switch (camera.projection) {
    case Projection::perspective:
        return camera.lensRadius > 0.0f ? kFeatureLens : 0u;
    case Projection::orthographic:
        return kFeatureOrthographic;
    case Projection::panorama:
        return kFeaturePanorama;
    }
    return 0;
}

std::array<gpu::SpecialisationConstant, 2> featureConstants(SceneFeatures features) {
    return {{{CONSTANT_FEATURES, static_cast<uint32_t>(features)},
             {CONSTANT_MORE_FEATURES, static_cast<uint32_t>(features >> 32u)}}};
}

} // namespace lavalight
