// Tests of node transforms and the node hierarchy.
#include <cmath>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_NEAR(glm::length(a - b), 0.0f, 1e-6f) << a.x << " " << a.y << " " << a.z;
}

TEST(GltfNodes, TranslationRotationScaleEqualsItsMatrix) {
    // 90 degrees about z, scaled by (2, 3, 4), moved by (5, 6, 7); the matrix is stored by columns.
    const float half = std::sqrt(0.5f);
    GltfBuilder trs;
    trs.addNode({{"mesh", trs.addTriangle()},
                 {"translation", {5, 6, 7}},
                 {"rotation", {0, 0, half, half}},
                 {"scale", {2, 3, 4}}});
    GltfBuilder matrix;
    matrix.addNode(
        {{"mesh", matrix.addTriangle()}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}});
    const Mesh a = trs.import().meshes.at(0);
    const Mesh b = matrix.import().meshes.at(0);
    const std::vector<glm::vec3> expected = {{5, 6, 7}, {5, 8, 7}, {2, 6, 7}};
    for (size_t i = 0; i < 3; ++i) {
        expectNear(a.positions.at(i), expected[i]);
        expectNear(b.positions.at(i), expected[i]);
    }
}

TEST(GltfNodes, ChildrenAreMovedByTheirParents) {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    builder.addNode({{"children", {1}}, {"scale", {2, 2, 2}}});
    builder.addNode({{"children", {2}}, {"translation", {1, 0, 0}}});
    builder.addNode({{"mesh", mesh}, {"translation", {0, 1, 0}}});
    expectNear(builder.import().meshes.at(0).positions.at(0), {2, 2, 0});
}

TEST(GltfNodes, MirroredFrontFacesStayCounterClockwise) {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    builder.addNode({{"mesh", mesh}, {"scale", {-1, 1, 1}}});   // the front still faces +z
    builder.addNode({{"mesh", mesh}, {"scale", {-1, -1, 1}}});  // a rotation, no mirror
    builder.addNode({{"mesh", mesh}, {"scale", {1, 1, -1}}});   // now it faces -z
    builder.addNode({{"mesh", mesh}, {"scale", {-1, -1, -1}}}); // and so here
    const Scene scene = builder.import();
    ASSERT_EQ(scene.meshes.size(), 4u);
    expectNear(frontOf(scene.meshes[0], 0), {0, 0, 1});
    expectNear(frontOf(scene.meshes[1], 0), {0, 0, 1});
    expectNear(frontOf(scene.meshes[2], 0), {0, 0, -1});
    expectNear(frontOf(scene.meshes[3], 0), {0, 0, -1});
}

TEST(GltfNodes, NormalsStayPerpendicularUnderNonUniformAndMirroringScales) {
    for (const float sign : {1.0f, -1.0f}) {
        GltfBuilder builder;
        const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, -1}, {0, 1, 0}};
        const glm::vec3 n = glm::normalize(glm::cross(corners[1], corners[2]));
        const Json attributes = {{"POSITION", builder.addVec3(corners)},
                                 {"NORMAL", builder.addVec3({n, n, n})}};
        builder.addNode(
            {{"mesh", builder.addMesh({{"attributes", attributes}})}, {"scale", {sign * 5, 1, 0.25}}});
        const Scene scene = builder.import();
        expectNear(scene.meshes.at(0).normals.at(0), frontOf(scene.meshes[0], 0));
    }
}

TEST(GltfNodes, ScaleOfZeroAcrossAPlaneKeepsItsNormal) {
    GltfBuilder builder;
    const glm::vec3 n(0, 0, 1);
    const Json attributes = {{"POSITION", builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})},
                             {"NORMAL", builder.addVec3({n, n, n})}};
    builder.addNode({{"mesh", builder.addMesh({{"attributes", attributes}})}, {"scale", {1, 1, 0}}});
    expectNear(builder.import().meshes.at(0).normals.at(0), n);
}

TEST(GltfNodes, TheDefaultSceneIsShown) {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    builder.addNode({{"mesh", mesh}});
    builder.addNode({{"mesh", mesh}, {"translation", {7, 0, 0}}});
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    expectNear(builder.import().meshes.at(0).positions.at(0), {0, 0, 0});
    builder.json["scene"] = 1;
    const Scene scene = builder.import();
    EXPECT_EQ(scene.meshes.size(), 1u);
    expectNear(scene.meshes.at(0).positions.at(0), {7, 0, 0});
}

TEST(GltfNodes, CyclicGraphIsAnErrorThatNamesANode) {
    GltfBuilder builder;
    builder.addNode({{"children", {1}}, {"name", "ring"}});
    builder.addNode({{"children", {0}}, {"name", "ring"}});
    EXPECT_NE(importError(builder).find("cyclic"), std::string::npos) << importError(builder);
    EXPECT_NE(importError(builder).find("\"ring\""), std::string::npos);

    GltfBuilder self;
    self.addNode({{"children", {0}}});
    EXPECT_NE(importError(self).find("cyclic"), std::string::npos) << importError(self);
}

TEST(GltfNodes, NodeWithTwoParentsIsAnError) {
    GltfBuilder builder;
    builder.addNode({{"children", {2}}});
    builder.addNode({{"children", {2}}});
    builder.addNode({{"name", "shared"}});
    EXPECT_NE(importError(builder).find("node 2 \"shared\" is a child of both node 0 and node 1"),
              std::string::npos)
        << importError(builder);
}

TEST(GltfNodes, SceneMayNotListAChildOrANodeTwice) {
    GltfBuilder builder;
    builder.addNode({{"children", {1}}});
    builder.addNode({{"name", "child"}});
    builder.json["scenes"] = {{{"nodes", {1}}}};
    EXPECT_NE(importError(builder).find("which is a child of node 0"), std::string::npos);
    builder.json["scenes"] = {{{"nodes", {0, 0}}}};
    EXPECT_NE(importError(builder).find("listed twice"), std::string::npos);
}

TEST(GltfNodes, ChainOfAHundredThousandNodesImports) {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    constexpr int kNodes = 100'000;
    for (int i = 0; i + 1 < kNodes; ++i)
        builder.addNode({{"children", {i + 1}}});
    builder.addNode({{"mesh", mesh}});
    EXPECT_EQ(builder.import().triangleCount(), 1u);
}

} // namespace
} // namespace lavalight::test
