// Tests of instances (EXT_mesh_gpu_instancing) and of hidden nodes (KHR_node_visibility).
#include <cmath>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

Json instancing(const Json& attributes) {
    return {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}};
}

int addVec4(GltfBuilder& builder, const std::vector<glm::vec4>& values) {
    return builder.addAccessor({{"bufferView", builder.addView(values)},
                                {"componentType", kFloat},
                                {"count", values.size()},
                                {"type", "VEC4"}});
}

TEST(GltfInstancing, EachInstanceIsScaledTurnedAndMovedBeforeItsNode) {
    GltfBuilder builder;
    const float half = std::sqrt(0.5f);
    const int translations = builder.addVec3({{0, 0, 0}, {5, 0, 0}});
    const int rotations = addVec4(builder, {{0, 0, 0, 1}, {0, 0, half, half}}); // a quarter turn about z
    const int scales = builder.addVec3({{1, 1, 1}, {2, 1, 1}});
    builder.addNode(
        {{"mesh", builder.addTriangle()},
         {"translation", {0, 0, 9}},
         {"extensions",
          instancing({{"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}})}});
    const Scene scene = builder.import();
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.meshes[0].positions.at(1), glm::vec3(1, 0, 9));
    EXPECT_NEAR(glm::length(scene.meshes[1].positions.at(1) - glm::vec3(5, 2, 9)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(scene.meshes[1].positions.at(2) - glm::vec3(4, 0, 9)), 0.0f, 1e-6f);
}

TEST(GltfInstancing, RotationsMayBeNormalizedBytes) {
    GltfBuilder builder;
    const std::vector<int8_t> halfTurn = {0, 0, 127, 0};
    const int rotations = builder.addAccessor({{"bufferView", builder.addView(halfTurn)},
                                               {"componentType", kByte},
                                               {"normalized", true},
                                               {"count", 1},
                                               {"type", "VEC4"}});
    builder.addNode({{"mesh", builder.addTriangle()}, {"extensions", instancing({{"ROTATION", rotations}})}});
    EXPECT_NEAR(glm::length(builder.import().meshes.at(0).positions.at(1) - glm::vec3(-1, 0, 0)), 0.0f,
                1e-6f);
}

TEST(GltfInstancing, UnequalCountsAndOtherTypesAreRefused) {
    GltfBuilder unequal;
    const int translations = unequal.addVec3({{0, 0, 0}, {5, 0, 0}});
    const int scales = unequal.addVec3({{1, 1, 1}});
    unequal.addNode({{"mesh", unequal.addTriangle()},
                     {"extensions", instancing({{"TRANSLATION", translations}, {"SCALE", scales}})}});
    EXPECT_NE(importError(unequal).find("has 1 elements instead of 2"), std::string::npos);

    GltfBuilder wrong;
    const int rotations = wrong.addVec3({{0, 0, 0}});
    wrong.addNode({{"mesh", wrong.addTriangle()}, {"extensions", instancing({{"ROTATION", rotations}})}});
    EXPECT_NE(importError(wrong).find("must be a VEC4"), std::string::npos);
}

TEST(GltfInstancing, MoreTrianglesThanFitAreRefusedBeforeTheyAreMade) {
    GltfBuilder builder; // a strip of 16 million triangles and 16 million instances, all of zeros
    constexpr int kMany = 1 << 24;
    const int zeros = builder.addAccessor({{"componentType", kFloat}, {"count", kMany}, {"type", "VEC3"}});
    const int mesh = builder.addMesh({{"attributes", {{"POSITION", zeros}}}, {"mode", 5}});
    builder.addNode({{"mesh", mesh}, {"extensions", instancing({{"TRANSLATION", zeros}})}});
    EXPECT_NE(importError(builder).find("are supported: simplify"), std::string::npos)
        << importError(builder);
}

TEST(GltfVisibility, HiddenNodesTakeMeshesAndLightsBelowWithThemButNoCameras) {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    builder.addNode({{"children", {1, 2}},
                     {"mesh", mesh},
                     {"camera", 0},
                     {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
    builder.addNode({{"mesh", mesh}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}});
    builder.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.addNode({{"mesh", mesh}, {"translation", {7, 0, 0}}});
    const Scene scene = builder.import();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions.at(0), glm::vec3(7, 0, 0));
    EXPECT_TRUE(scene.punctualLights.empty());
    EXPECT_EQ(scene.cameras.at(0).name, "eye");
}

} // namespace
} // namespace lavalight::test
