// Tests of classes of materials, and of what their kernels may leave out.
#include "device_scene/material_classes.h"

#include <gtest/gtest.h>

namespace lavalight {
namespace {

Material lambert() {
    Material material;
    material.metallic = 0.0f;
    material.specular = 0.0f;
    return material;
}

// A scene with a mesh for each material.
Scene wearing(std::vector<Material> materials) {
    Scene scene;
    scene.materials = std::move(materials);
    for (uint32_t i = 0; i < scene.materials.size(); ++i) {
        Mesh mesh;
        mesh.material = i;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        mesh.triangles = {{0, 1, 2}};
        scene.meshes.push_back(mesh);
    }
    return scene;
}

bool leavesOut(const MaterialClasses& classes, uint32_t material, SceneFeatures feature) {
    return (classes.list[classes.ofMaterials[material]].without & feature) != 0;
}

TEST(MaterialClasses, ALambertSurfacePaysForNoOther) {
    Material glass = lambert();
    glass.specular = 1.0f;
    glass.transmission = 1.0f;
    Material lamp = lambert();
    lamp.emission = glm::vec3(1.0f);
    const MaterialClasses classes = materialClasses(wearing({lambert(), glass, lamp}));
    ASSERT_EQ(classes.list.size(), 3u);
    EXPECT_EQ(classes.list[classes.ofMaterials[0]].name, "lambert");
    for (const SceneFeatures feature : {kFeatureGlass, kFeatureSpecular, kFeatureEmission})
        EXPECT_TRUE(leavesOut(classes, 0, feature));
    EXPECT_FALSE(leavesOut(classes, 1, kFeatureGlass));
    EXPECT_TRUE(leavesOut(classes, 1, kFeatureEmission));
    EXPECT_FALSE(leavesOut(classes, 2, kFeatureEmission));
    EXPECT_TRUE(leavesOut(classes, 2, kFeatureGlass));
}

TEST(MaterialClasses, ThereAreNoneThatNothingWears) {
    Scene scene = wearing({lambert(), Material{}});
    scene.meshes.pop_back();
    const MaterialClasses classes = materialClasses(scene);
    ASSERT_EQ(classes.list.size(), 1u);
    EXPECT_EQ(classes.ofMaterials.size(), 2u);
    EXPECT_EQ(materialClasses(Scene{}).list.size(), 1u) << "a scene of nothing has one, too";
}

// A vertex of any material samples them.
TEST(MaterialClasses, AllKeepWhatLightsNeed) {
    Material lamp = lambert();
    lamp.emission = glm::vec3(1.0f);
    lamp.clearcoat = 1.0f;
    lamp.textures[static_cast<size_t>(TextureSlot::emission)] = Texture{};
    const MaterialClasses classes = materialClasses(wearing({lambert(), lamp}));
    ASSERT_EQ(classes.list.size(), 2u);
    for (const SceneFeatures feature : {kFeatureTextures, kFeatureClearcoat, kFeatureCoatedLights})
        EXPECT_FALSE(leavesOut(classes, 0, feature));
    EXPECT_TRUE(leavesOut(classes, 0, kFeatureEmission));
}

// A metal that bounds a solid may stand in a dispersing one.
TEST(MaterialClasses, BoundariesKeepDispersion) {
    Material prism = lambert();
    prism.transmission = 1.0f;
    prism.isSolid = true;
    prism.dispersion = 1.0f;
    Material metal;
    Scene scene = wearing({prism, metal, lambert()});
    scene.meshes[0].solid = 1;
    scene.meshes[1].solid = 2;
    const MaterialClasses classes = materialClasses(scene);
    EXPECT_FALSE(leavesOut(classes, 1, kFeatureDispersion));
    EXPECT_TRUE(leavesOut(classes, 2, kFeatureDispersion));
}

} // namespace
} // namespace lavalight
