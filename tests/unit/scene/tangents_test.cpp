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

const std::vector kPlain{TangentSpace{}};

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
    generateTangents(mesh, kPlain);
    ASSERT_EQ(mesh.tangents.size(), 4u);
    for (const glm::vec4& tangent : mesh.tangents)
        EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1)); // cross(z, x) is y
}

TEST(Tangents, VerticesOfMirroredAndPlainTrianglesBecomeTwo) {
    Mesh mesh = square(true);
    generateTangents(mesh, kPlain);
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
    generateTangents(mesh, kPlain);
    EXPECT_EQ(mesh.tangents.at(1), mesh.tangents.at(3));
    EXPECT_EQ(mesh.tangents.at(1).y, 0.0f); // along the surface that the normal means
}

TEST(Tangents, FlatMeshStaysFlatAndHasTangentsOnItsTriangles) {
    Mesh mesh = square(false);
    mesh.positions[3].z = 1.0f;
    mesh.normals.clear();
    generateTangents(mesh, kPlain);
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
    generateTangents(mesh, kPlain);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f);
        EXPECT_EQ(tangent.z, 0.0f);
    }
    Mesh bare = square(false);
    generateTangents(bare, std::vector{TangentSpace{.uvSet = 1}});
    EXPECT_TRUE(bare.tangents.empty());
}

void setTexture(Material& material, TextureSlot slot, const Texture& texture) {
    material.textures[static_cast<size_t>(slot)] = texture;
}

TEST(Tangents, MaterialsWantThemForNormalTexturesAndAnisotropy) {
    Material material;
    EXPECT_TRUE(tangentSpaces(material).spaces.empty());
    material.anisotropy = 0.5f;
    EXPECT_EQ(tangentSpaces(material).spaces, kPlain);
    setTexture(material, TextureSlot::anisotropy, Texture{.uvSet = 2});
    EXPECT_EQ(tangentSpaces(material).spaces, std::vector{TangentSpace{.uvSet = 2}});
    EXPECT_EQ(tangentSpaces(material).anisotropy, 0u);
    setTexture(material, TextureSlot::normal, Texture{.uvSet = 1});
    EXPECT_EQ(tangentSpaces(material).spaces,
              (std::vector{TangentSpace{.uvSet = 1}, TangentSpace{.uvSet = 2}}));
    EXPECT_EQ(tangentSpaces(material).anisotropy, 1u);
}

TEST(Tangents, SpacesAreThoseOfTheTexturesCoordinatesAndEachIsThereOnce) {
    Material material;
    material.anisotropy = 0.5f;
    // A quarter turn, moved.
    const Texture turned{.uvSet = 1, .uRow = {0, 1, 0.3f}, .vRow = {-1, 0, 0.4f}};
    const TangentSpace quarter{.uvSet = 1, .uRow = {0, 1}, .vRow = {-1, 0}};
    setTexture(material, TextureSlot::clearcoatNormal, turned);
    EXPECT_EQ(tangentSpaces(material).spaces, std::vector{quarter}); // anisotropy without a texture follows
    setTexture(material, TextureSlot::normal, Texture{});
    setTexture(material, TextureSlot::anisotropy, turned);
    const TangentSpaces wanted = tangentSpaces(material);
    EXPECT_EQ(wanted.spaces, (std::vector{TangentSpace{}, quarter}));
    EXPECT_EQ(wanted.coat, 1u);
    EXPECT_EQ(wanted.anisotropy, 1u);
}

// A bent sheet of 4 x 4 squares with normals, whose coordinates are the picture of `space`.
Mesh sheet(const TangentSpace& space, bool isFlat) {
    Mesh mesh;
    mesh.uvs.resize(1);
    for (int y = 0; y <= 4; ++y)
        for (int x = 0; x <= 4; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / 4.0f;
            mesh.positions.emplace_back(x, 0.7f * static_cast<float>(y), 0.1f * static_cast<float>(x * y));
            if (!isFlat)
                mesh.normals.push_back(glm::normalize(glm::vec3(-0.1f * static_cast<float>(y), 0.1f, 1.0f)));
            mesh.uvs[0].emplace_back(glm::dot(space.uRow, uv), glm::dot(space.vRow, uv));
        }
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 4; ++x) {
            const uint32_t i = 5 * y + x;
            mesh.triangles.emplace_back(i, i + 1, i + 6);
            mesh.triangles.emplace_back(i, i + 6, i + 5);
        }
    return mesh;
}

// KHR_texture_transform: what a transform does to coordinates, it does to their directions.
TEST(Tangents, SpaceOfATransformIsThatOfTheCoordinatesThatItMakes) {
    const float c = std::cos(0.7f);
    const float s = std::sin(0.7f);
    const std::vector<TangentSpace> spaces = {
        {0, {1, 0}, {0, 1}},         {0, {0, 1}, {-1, 0}},
        {0, {c, s}, {-s, c}},        {0, {-1, 0}, {0, 1}}, // mirrored
        {0, {1, 0}, {0, -1}},        {0, {-1, 0}, {0, -1}},
        {0, {3 * c, s}, {-3 * s, c}} // sheared on the surface: scaled unevenly, then turned
    };
    for (const bool isFlat : {false, true}) {
        Mesh all = sheet({}, isFlat);
        generateTangents(all, spaces);
        ASSERT_EQ(all.furtherTangents.size(), spaces.size() - 1);
        for (size_t i = 0; i < spaces.size(); ++i) {
            Mesh baked = sheet(spaces[i], isFlat);
            generateTangents(baked, kPlain);
            const std::vector<glm::vec4>& ours = i == 0 ? all.tangents : all.furtherTangents[i - 1];
            ASSERT_EQ(ours.size(), all.positions.size());
            for (size_t t = 0; t < all.triangles.size(); ++t)
                for (int corner = 0; corner < 3; ++corner) {
                    const glm::vec4& a = ours[all.triangles[t][corner]];
                    const glm::vec4& b = baked.tangents.at(baked.triangles[t][corner]);
                    EXPECT_LT(glm::length(a - b), 1e-5f) << "space " << i;
                }
        }
    }
}

// The second space mirrors one of two triangles, so that it needs vertices that the first does not.
TEST(Tangents, SpacesOfSeveralUvSetsShareTheirVertices) {
    Mesh mesh = square(false);
    mesh.uvs.push_back(square(true).uvs[0]);
    generateTangents(mesh, std::vector{TangentSpace{}, TangentSpace{.uvSet = 1}, TangentSpace{.uvSet = 7}});
    EXPECT_EQ(mesh.positions.size(), 6u);
    ASSERT_EQ(mesh.furtherTangents.size(), 2u);
    EXPECT_TRUE(mesh.furtherTangents[1].empty());
    for (int corner = 0; corner < 3; ++corner) {
        EXPECT_EQ(mesh.tangents.at(mesh.triangles[1][corner]), glm::vec4(1, 0, 0, 1));
        EXPECT_EQ(mesh.furtherTangents[0].at(mesh.triangles[0][corner]), glm::vec4(1, 0, 0, 1));
        EXPECT_EQ(mesh.furtherTangents[0].at(mesh.triangles[1][corner]), glm::vec4(0, 1, 0, -1));
    }
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
        generateTangents(ours, kPlain);
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
