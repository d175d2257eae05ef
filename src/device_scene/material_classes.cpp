#include "device_scene/material_classes.h"

#include <array>

#include "device_scene/scene_features.h"

namespace lavalight {
namespace {

constexpr std::array<std::string_view, 3> kNames{"lambert", "plain", "general"};

// What makes a kernel long, and what few materials of a scene have.
constexpr SceneFeatures kRare = kFeatureTextures | kFeatureVertexColors | kFeatureTangents | kFeatureUnlit |
                                kFeatureEmission | kFeatureAttenuation | kFeatureDispersion |
                                kFeatureDiffuseTransmission;

// What the emission of a surface may depend on. A vertex of any material samples lights.
constexpr SceneFeatures kOfLights = kFeatureTextures | kFeatureVertexColors | kFeatureTangents |
                                    kFeatureTangentPlanes | kFeatureClearcoat | kFeatureCoatedLights |
                                    kFeatureShadingNormals;

size_t classOf(SceneFeatures surface) {
    if ((surface & ~kFeatureShadingNormals) == 0)
        return 0;
    return (surface & kRare) == 0 ? 1 : 2;
}

} // namespace

MaterialClasses materialClasses(const Scene& scene) {
    const std::vector<SceneFeatures> surfaces = surfaceFeatures(scene);
    std::array<SceneFeatures, kNames.size()> ofClasses{};
    std::array<bool, kNames.size()> isUsed{};
    SceneFeatures ofAll = 0;
    SceneFeatures ofLights = 0;
    std::vector<bool> isWorn(surfaces.size(), false);
    std::array<bool, kNames.size()> bounds{}; // boundaries of solids are in the class
    for (const Mesh& mesh : scene.meshes) {
        isWorn[mesh.material] = true;
        bounds[classOf(surfaces[mesh.material])] |= mesh.solid != 0;
    }
    for (size_t i = 0; i < surfaces.size(); ++i) {
        ofAll |= surfaces[i];
        ofLights |= (surfaces[i] & kFeatureEmission) != 0 ? surfaces[i] & kOfLights : 0u;
        ofClasses[classOf(surfaces[i])] |= surfaces[i];
        isUsed[classOf(surfaces[i])] = isUsed[classOf(surfaces[i])] || isWorn[i];
    }
    for (size_t i = 0; i < kNames.size(); ++i)
        if (bounds[i]) // what is beyond a boundary may disperse in its place
            ofClasses[i] |= ofAll & kFeatureDispersion;
    MaterialClasses classes;
    std::array<uint8_t, kNames.size()> places{};
    for (size_t i = 0; i < kNames.size(); ++i) {
        places[i] = static_cast<uint8_t>(classes.list.size());
        if (isUsed[i])
            classes.list.push_back({kNames[i], ofAll & ~(ofClasses[i] | ofLights)});
    }
    if (classes.list.empty())
        classes.list.push_back({kNames[0], 0});
    for (const SceneFeatures surface : surfaces)
        classes.ofMaterials.push_back(places[classOf(surface)]);
    return classes;
}

} // namespace lavalight
