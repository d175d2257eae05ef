// What a scene is said to have: a feature that it has and that is not reported
// would be missing from its image.
#include <gtest/gtest.h>

#include "device_scene/scene_features.h"
#include "session/builtin.h"
#include "shared/frame.h"
#include "shared/scene.h"

namespace lavalight::test {
namespace {

Material lambert() {
    Material material;
    material.metallic = 0.0f;
    material.specular = 0.0f;
    return material;
}

SceneFeatures featuresOf(const Scene& scene) {
    return sceneFeatures(scene, collectLights(scene, scene.environment, LightSelection::power));
}

SceneFeatures featuresOf(const Material& material) {
    Scene scene;
    scene.materials = {lambert(), material};
    scene.meshes.emplace_back().material = 1;
    return featuresOf(scene);
}

TEST(SceneFeatures, ReachKernelsAsTwoWords) {
    const auto words = featureConstants(kFeatureGlass | kFeatureLights | kFeatureLens | kFeatureSolids);
    EXPECT_EQ(words[0], (gpu::SpecialisationConstant{CONSTANT_FEATURES, 1u << 1 | 1u << 22}));
    EXPECT_EQ(words[1], (gpu::SpecialisationConstant{CONSTANT_MORE_FEATURES, 1u << 0 | 1u << 3}));
}

TEST(SceneFeatures, LambertSurfacesHaveNone) {
    EXPECT_EQ(featuresOf(lambert()), 0u);
}

TEST(SceneFeatures, MetalsAndCoatingsAreSpecularAndRoughUnlessTheyAreMirrors) {
    Material metal = lambert();
    metal.metallic = 0.5f;
    EXPECT_EQ(featuresOf(metal), kFeatureSpecular | kFeatureRoughLobes);
    metal.roughness = 0.01f;
    EXPECT_EQ(featuresOf(metal), kFeatureSpecular | kFeatureSmoothLobes);
    Material coated = lambert();
    coated.specular = 0.1f;
    EXPECT_EQ(featuresOf(coated), kFeatureSpecular | kFeatureRoughLobes);
}

TEST(SceneFeatures, LightsBelowACoatAreNamed) {
    Material lamp = lambert();
    lamp.emission = glm::vec3(1.0f);
    EXPECT_EQ(featuresOf(lamp) & kFeatureCoatedLights, 0u);
    lamp.clearcoat = 0.5f;
    EXPECT_NE(featuresOf(lamp) & kFeatureCoatedLights, 0u);
    lamp.isUnlit = true;
    EXPECT_EQ(featuresOf(lamp) & kFeatureCoatedLights, 0u);
}

TEST(SceneFeatures, GlassIsWhatTransmitsAndIsNoMetal) {
    Material glass = lambert();
    glass.transmission = 0.5f;
    glass.roughness = 0.0f;
    EXPECT_EQ(featuresOf(glass), kFeatureGlass | kFeatureSmoothLobes);
    glass.metallic = 1.0f;
    EXPECT_EQ(featuresOf(glass), kFeatureSpecular | kFeatureSmoothLobes);
}

TEST(SceneFeatures, TexturesMayMakeMirrorsAndGlassOfWhatTheFactorsMakeRoughOrMetal) {
    Material metal = lambert();
    metal.metallic = 1.0f;
    metal.transmission = 1.0f;
    metal.textures[kSlotMetallicRoughness] = Texture{};
    EXPECT_EQ(featuresOf(metal),
              kFeatureSpecular | kFeatureGlass | kFeatureRoughLobes | kFeatureSmoothLobes | kFeatureTextures);
    Material glossy = lambert();
    glossy.specular = 1.0f;
    glossy.roughness = 0.0f;
    glossy.isGlossiness = true;
    glossy.textures[kSlotSpecularColor] = Texture{};
    EXPECT_EQ(featuresOf(glossy),
              kFeatureSpecular | kFeatureRoughLobes | kFeatureSmoothLobes | kFeatureTextures);
}

TEST(SceneFeatures, NormalMapsWantTangentsAndSolidsOfColourAttenuation) {
    Material mapped = lambert();
    mapped.textures[kSlotNormal] = Texture{};
    EXPECT_EQ(featuresOf(mapped), kFeatureTextures | kFeatureTangents);
    Material body = lambert();
    body.transmission = 1.0f;
    body.isSolid = true;
    body.attenuationColor = {1.0f, 0.5f, 0.5f};
    EXPECT_EQ(featuresOf(body) & kFeatureAttenuation, 0u);
    body.attenuationDistance = 1.0f;
    EXPECT_EQ(featuresOf(body) & kFeatureAttenuation, kFeatureAttenuation);
    body.isSolid = false;
    EXPECT_EQ(featuresOf(body) & kFeatureAttenuation, 0u) << "a thin wall";
    Material unlit = lambert();
    unlit.isUnlit = true;
    EXPECT_EQ(featuresOf(unlit), kFeatureUnlit);
}

TEST(SceneFeatures, ColoursAndAlphaOfMeshesAreNamed) {
    Scene scene;
    scene.materials = {lambert()};
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.colors.assign(3, glm::vec4(0.5f));
    scene.meshes = {mesh};
    EXPECT_EQ(featuresOf(scene), kFeatureVertexColors);
    scene.materials.front().alphaMode = AlphaMode::blend;
    EXPECT_EQ(featuresOf(scene), kFeatureVertexColors | kFeatureAlpha);
}

TEST(SceneFeatures, ManyTrianglesAreNamed) {
    EXPECT_EQ(featuresOf(loadScene("dense-9000")) & kFeatureManyTriangles, 0u);
    EXPECT_EQ(featuresOf(loadScene("dense-11000")) & kFeatureManyTriangles, kFeatureManyTriangles);
}

TEST(SceneFeatures, LobesOfExtensionsAreNamed) {
    Material material = lambert();
    material.clearcoat = 0.5f;
    EXPECT_EQ(featuresOf(material), kFeatureClearcoat | kFeatureSmoothLobes);
    material.clearcoatRoughness = 0.5f;
    EXPECT_EQ(featuresOf(material), kFeatureClearcoat | kFeatureRoughLobes);
    material = lambert();
    material.sheenColor = {0.0f, 0.1f, 0.0f};
    EXPECT_EQ(featuresOf(material), kFeatureSheen);
    material = lambert();
    material.diffuseTransmission = 0.5f;
    EXPECT_EQ(featuresOf(material), kFeatureDiffuseTransmission);
    Material metal = lambert();
    metal.metallic = 1.0f;
    metal.roughness = 0.0f;
    metal.iridescence = 0.5f;
    EXPECT_EQ(featuresOf(metal), kFeatureSpecular | kFeatureSmoothLobes | kFeatureIridescence);
    metal.iridescence = 0.0f;
    metal.anisotropy = 0.5f; // rough along one axis
    EXPECT_EQ(featuresOf(metal), kFeatureSpecular | kFeatureSmoothLobes | kFeatureRoughLobes |
                                     kFeatureAnisotropy | kFeatureTangents);
}

TEST(SceneFeatures, OnlySolidGlassDisperses) {
    Material glass = lambert();
    glass.transmission = 1.0f;
    glass.dispersion = 1.0f;
    EXPECT_EQ(featuresOf(glass), kFeatureGlass | kFeatureRoughLobes);
    glass.isSolid = true;
    EXPECT_EQ(featuresOf(glass), kFeatureGlass | kFeatureRoughLobes | kFeatureDispersion);
}

TEST(SceneFeatures, ListsOfSolidsAreKeptWhereTheyMatter) {
    Material glass = lambert();
    glass.isSolid = true;
    glass.transmission = 1.0f;
    const auto wants = [](const Material& material, std::initializer_list<Bounds> boxes) {
        Scene scene;
        scene.materials = {material};
        for (const Bounds& box : boxes) {
            scene.solids.push_back({static_cast<uint32_t>(scene.meshes.size()), box});
            scene.meshes.emplace_back().solid = static_cast<uint32_t>(scene.solids.size());
        }
        return wantsInteriorLists(scene);
    };
    const auto box = [](float from, float to) { return Bounds{glm::vec3(from), glm::vec3(to)}; };
    EXPECT_FALSE(wants(glass, {box(0, 1), box(1.01f, 2)}));
    EXPECT_TRUE(wants(glass, {box(0, 1), box(1, 2)})) << "they touch";
    EXPECT_TRUE(wants(glass, {box(0, 1), box(3, 4), box(0.5f, 2)}));
    EXPECT_TRUE(wants(glass, {box(0, 10), {{1, 20, 0}, {2, 21, 1}}, {{3, 9, 0}, {4, 11, 1}}}))
        << "another lies between them along x";
    EXPECT_TRUE(wants(glass, {box(1000, 1000.001f)})) << "thin for its place";
    for (const glm::vec3& thin : {glm::vec3(0.001f, 1, 1), {1, 0.001f, 1}, {1, 1, 0.001f}})
        EXPECT_TRUE(wants(glass, {{glm::vec3(1000.0f), 1000.0f + thin}})) << "along one axis";
    EXPECT_FALSE(wants(glass, {box(1000, 1001)}));
    glass.attenuationColor = glm::vec3(0.5f);
    glass.attenuationDistance = 1.0f;
    EXPECT_TRUE(wants(glass, {box(0, 1)}));
    EXPECT_FALSE(wants(glass, {}));
}

// Closed bodies that attenuate are solids, open ones are not.
TEST(SceneFeatures, SolidsAreNamedAndAttenuateByTheirLists) {
    Scene scene;
    Material body = lambert();
    body.isSolid = true;
    body.transmission = 1.0f;
    body.attenuationColor = glm::vec3(0.5f);
    body.attenuationDistance = 1.0f;
    scene.materials = {body};
    scene.meshes.emplace_back();
    const SceneFeatures both = kFeatureSolids | kFeatureAttenuation;
    EXPECT_EQ(featuresOf(scene) & both, kFeatureAttenuation);
    scene.solids.push_back({0, {glm::vec3(0.0f), glm::vec3(1.0f)}});
    scene.meshes.front().solid = 1;
    EXPECT_EQ(featuresOf(scene) & both, kFeatureSolids);
}

TEST(SceneFeatures, LightsAndNormalsAreNamed) {
    Scene scene;
    scene.materials = {lambert()};
    scene.environment = glm::vec3(1.0f);
    scene.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    EXPECT_EQ(featuresOf(scene), kFeatureEnvironment | kFeatureLights | kFeatureEnvironmentLight);
    scene.environment = glm::vec3(0.0f);
    scene.punctualLights.emplace_back();
    EXPECT_EQ(featuresOf(scene), kFeaturePunctualLights | kFeatureLights);
    scene.punctualLights.clear();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes = {mesh};
    EXPECT_EQ(featuresOf(scene), 0u);
    scene.materials.front().emission = glm::vec3(1.0f);
    EXPECT_EQ(featuresOf(scene), kFeatureTriangleLights | kFeatureLights | kFeatureEmission);
    scene.meshes.front().normals.assign(3, {0, 0, 1});
    EXPECT_EQ(featuresOf(scene),
              kFeatureTriangleLights | kFeatureLights | kFeatureEmission | kFeatureShadingNormals);
}

TEST(SceneFeatures, EachKindOfCameraIsOne) {
    Camera camera;
    EXPECT_EQ(cameraFeatures(camera), 0u);
    camera.lensRadius = 0.1f;
    EXPECT_EQ(cameraFeatures(camera), kFeatureLens);
    camera.projection = Projection::orthographic;
    EXPECT_EQ(cameraFeatures(camera), kFeatureOrthographic);
    camera.projection = Projection::panorama;
    EXPECT_EQ(cameraFeatures(camera), kFeaturePanorama);
}

} // namespace
} // namespace lavalight::test
