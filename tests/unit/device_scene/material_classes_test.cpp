// Tests of classes of materials, and of what their kernels may leave out.
#include "device_scene/material_classes.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace lavalight::test {
namespace {

const Material kLambert = lambert(glm::vec3(1.0f));

// A scene with a mesh for each material.
Scene wearing(const std::vector<Material>& materials) {
    SceneBuilder builder;
    for (const Material& material : materials)
        builder.add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), material);
    return builder.build();
}

bool leavesOut(const MaterialClasses& classes, uint32_t material, SceneFeatures feature) {
    return (classes.list[classes.ofMaterials[material]].without & feature) != 0;
}

TEST(MaterialClasses, ALambertSurfacePaysForNoOther) {
    Material glass = kLambert;
    glass.specular = 1.0f;
    glass.transmission = 1.0f;
    const MaterialClasses classes = materialClasses(wearing({kLambert, glass, light(glm::vec3(1.0f))}));
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
    Scene scene = wearing({kLambert, Material{}});
    scene.meshes.pop_back();
    const MaterialClasses classes = materialClasses(scene);
    ASSERT_EQ(classes.list.size(), 1u);
    EXPECT_EQ(classes.ofMaterials.size(), 2u);
    EXPECT_EQ(materialClasses(Scene{}).list.size(), 1u) << "a scene of nothing has one, too";
}

// A vertex of any material samples them.
TEST(MaterialClasses, AllKeepWhatLightsNeed) {
    Material lamp = light(glm::vec3(1.0f));
    lamp.clearcoat = 1.0f;
    lamp.textures[static_cast<size_t>(TextureSlot::emission)] = Texture{};
    const MaterialClasses classes = materialClasses(wearing({kLambert, lamp}));
    ASSERT_EQ(classes.list.size(), 2u);
    for (const SceneFeatures feature : {kFeatureTextures, kFeatureClearcoat, kFeatureCoatedLights})
        EXPECT_FALSE(leavesOut(classes, 0, feature));
    EXPECT_TRUE(leavesOut(classes, 0, kFeatureEmission));
}

// A metal that bounds a solid may stand in a dispersing one.
TEST(MaterialClasses, BoundariesKeepDispersion) {
    Material prism = kLambert;
    prism.transmission = 1.0f;
    prism.isSolid = true;
    prism.dispersion = 1.0f;
    Material metal;
    Scene scene = wearing({prism, metal, kLambert});
    scene.meshes[0].solid = 1;
    scene.meshes[1].solid = 2;
    const MaterialClasses classes = materialClasses(scene);
    EXPECT_FALSE(leavesOut(classes, 1, kFeatureDispersion));
    EXPECT_TRUE(leavesOut(classes, 2, kFeatureDispersion));
}

} // namespace
} // namespace lavalight::test
