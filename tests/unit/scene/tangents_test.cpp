// Tests of generated tangents: hand-made triangles, and real models that ship tangents of their own.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "gltf/import.h"
#include "scene/tangents.h"

namespace lavalight::test {
namespace {

// Two triangles of the unit square, facing +z, with one picture mirrored at the diagonal x = y if asked.
//   3---2
//   | / |
//   0---1
Mesh square(bool isMirrored) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.uvs = {{{0, 1}, {1, 1}, {1, 0}, isMirrored ? glm::vec2(1, 1) : glm::vec2(0, 0)}};
    return mesh;
}

TEST(Tangents, UprightPictureHasItsBitangentUp) {
    Mesh mesh = square(false);
    generateTangents(mesh, 0);
    ASSERT_EQ(mesh.tangents.size(), 4u);
    for (const glm::vec4& tangent : mesh.tangents)
        EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1)); // cross(z, x) is y
}

TEST(Tangents, VerticesOfMirroredAndPlainTrianglesBecomeTwo) {
    Mesh mesh = square(true);
    generateTangents(mesh, 0);
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.uvs.at(0).size(), 6u);
    for (int corner = 0; corner < 3; ++corner) {
        EXPECT_EQ(mesh.tangents.at(mesh.triangles[0][corner]), glm::vec4(1, 0, 0, 1));
        EXPECT_EQ(mesh.tangents.at(mesh.triangles[1][corner]), glm::vec4(0, 1, 0, -1));
    }
    EXPECT_EQ(mesh.positions.at(mesh.triangles[1].y), glm::vec3(1, 1, 0)); // the corner is where it was
}

TEST(Tangents, VerticesAtOnePlaceShareTheirTangentWhateverTheirNumbers) {
    Mesh mesh; // a roof whose ridge is stored twice
    mesh.positions = {{0, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 1, 0}, {2, 0, 0}, {1, 1, 1}};
    const glm::vec3 up(0, 1, 0);
    mesh.normals.assign(6, up);
    mesh.triangles = {{0, 2, 1}, {3, 5, 4}};
    mesh.uvs = {{{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}, {1, 1}}};
    generateTangents(mesh, 0);
    EXPECT_EQ(mesh.tangents.at(1), mesh.tangents.at(3));
    EXPECT_EQ(mesh.tangents.at(1).y, 0.0f); // along the surface that the normal means
}

TEST(Tangents, FlatMeshStaysFlatAndHasTangentsOnItsTriangles) {
    Mesh mesh = square(false);
    mesh.positions[3].z = 1.0f;
    mesh.normals.clear();
    generateTangents(mesh, 0);
    EXPECT_TRUE(mesh.normals.empty());
    ASSERT_EQ(mesh.tangents.size(), 6u);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 normal = glm::normalize(
            glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
        EXPECT_NEAR(glm::dot(normal, glm::vec3(mesh.tangents[t.x])), 0.0f, 1e-6f);
    }
}

TEST(Tangents, WithoutUvAreaTheyAreUnitVectorsAlongTheSurfaceAndWithoutUvsThereAreNone) {
    Mesh mesh = square(false);
    mesh.uvs[0].assign(4, glm::vec2(0.5f));
    generateTangents(mesh, 0);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f);
        EXPECT_EQ(tangent.z, 0.0f);
    }
    Mesh bare = square(false);
    generateTangents(bare, 1);
    EXPECT_TRUE(bare.tangents.empty());
}

TEST(Tangents, MaterialsWantThemForNormalTexturesAndAnisotropy) {
    Material material;
    EXPECT_EQ(tangentUvSet(material), std::nullopt);
    material.anisotropy = 0.5f;
    EXPECT_EQ(tangentUvSet(material), 0u);
    material.textures[static_cast<size_t>(TextureSlot::anisotropy)] = Texture{.uvSet = 2};
    EXPECT_EQ(tangentUvSet(material), 2u);
    material.textures[static_cast<size_t>(TextureSlot::normal)] = Texture{.uvSet = 1};
    EXPECT_EQ(tangentUvSet(material), 1u);
}

struct Difference {
    size_t corners = 0;
    std::vector<float> degrees;
    size_t otherHandedness = 0;
};

// How the tangents that a model ships differ from those generated without them, corner by corner.
Difference differenceOf(const Scene& scene) {
    Difference difference;
    for (const Mesh& shipped : scene.meshes) {
        if (shipped.tangents.empty())
            continue;
        Mesh ours = shipped;
        ours.tangents.clear();
        generateTangents(ours, 0);
        for (size_t i = 0; i < ours.triangles.size(); ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec4& a = shipped.tangents[shipped.triangles[i][corner]];
                const glm::vec4& b = ours.tangents.at(ours.triangles[i][corner]);
                const float cosine = std::clamp(glm::dot(glm::vec3(a), glm::vec3(b)), -1.0f, 1.0f);
                difference.degrees.push_back(glm::degrees(std::acos(cosine)));
                difference.otherHandedness += a.w != b.w;
            }
        }
    }
    std::sort(difference.degrees.begin(), difference.degrees.end());
    return difference;
}

class TangentsOf : public ::testing::TestWithParam<const char*> {};

TEST_P(TangentsOf, AreThoseThatTheModelShips) {
    const char* folder = std::getenv("LAVALIGHT_ASSETS");
    if (folder == nullptr)
        GTEST_SKIP() << "LAVALIGHT_ASSETS is not set: no models that ship tangents";
    const Difference difference = differenceOf(importGltf(std::filesystem::path(folder) / GetParam()));
    const std::vector<float>& degrees = difference.degrees;
    ASSERT_FALSE(degrees.empty());
    std::printf("%zu corners: median %.3f, 95%% below %.3f degrees; %zu of other handedness\n",
                degrees.size(), degrees[degrees.size() / 2], degrees[degrees.size() * 95 / 100],
                difference.otherHandedness);
    EXPECT_LT(degrees[degrees.size() / 2], 1.0f);
    EXPECT_LT(degrees[degrees.size() * 95 / 100], 5.0f);
    EXPECT_LT(difference.otherHandedness * 100, degrees.size());
}

INSTANTIATE_TEST_SUITE_P(Models, TangentsOf,
                         ::testing::Values("NormalTangentMirrorTest/glTF-Binary/NormalTangentMirrorTest.glb",
                                           "WaterBottle/glTF/WaterBottle.gltf",
                                           "FlightHelmet/glTF/FlightHelmet.gltf"));

} // namespace
} // namespace lavalight::test
