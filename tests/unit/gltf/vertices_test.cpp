// Tests of texture coordinates, vertex colours and tangents as the import hands them on.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// The triangle of GltfBuilder::addTriangle with more attributes and one node that shows it.
Mesh importWith(GltfBuilder& builder, const Json& attributes, const Json& node = Json::object()) {
    Json all = {{"POSITION", builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}};
    all.update(attributes);
    Json placed = {{"mesh", builder.addMesh({{"attributes", all}})}};
    placed.update(node);
    builder.addNode(placed);
    return builder.import().meshes.at(0);
}

template <class T>
int addElements(GltfBuilder& builder, const std::vector<T>& values, const char* type, Json accessor) {
    accessor["bufferView"] = builder.addView(values);
    accessor["type"] = type;
    accessor["count"] = 3;
    return builder.addAccessor(accessor);
}

int addUp(GltfBuilder& builder) {
    return builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
}

TEST(GltfVertices, TextureCoordinatesOfEveryTypeAreReadIntoTheirSets) {
    GltfBuilder builder;
    const int first =
        addElements<glm::vec2>(builder, {{0, 1}, {-2, 0.5f}, {7, 8}}, "VEC2", {{"componentType", kFloat}});
    const int third = addElements<uint16_t>(builder, {65535, 0, 0, 65535, 13107, 0}, "VEC2",
                                            {{"componentType", kUnsignedShort}, {"normalized", true}});
    const int fourth =
        addElements<int16_t>(builder, {4, -5, 6, 7, 8, 9}, "VEC2", {{"componentType", kShort}});
    const Mesh mesh =
        importWith(builder, {{"TEXCOORD_0", first}, {"TEXCOORD_2", third}, {"TEXCOORD_3", fourth}});
    ASSERT_EQ(mesh.uvs.size(), 4u);
    EXPECT_EQ(mesh.uvs[0], (std::vector<glm::vec2>{{0, 1}, {-2, 0.5f}, {7, 8}}));
    EXPECT_TRUE(mesh.uvs[1].empty());
    EXPECT_EQ(mesh.uvs[2], (std::vector<glm::vec2>{{1, 0}, {0, 1}, {0.2f, 0}}));
    EXPECT_EQ(mesh.uvs[3], (std::vector<glm::vec2>{{4, -5}, {6, 7}, {8, 9}}));
    EXPECT_TRUE(mesh.normals.empty()); // flat meshes keep their uvs
}

TEST(GltfVertices, ColoursWithoutAlphaAreOpaqueAndAllAreClamped) {
    GltfBuilder three;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Mesh opaque =
        importWith(three, {{"COLOR_0", three.addVec3({{2, 0.5f, -1}, {0, 0, 1}, {nan, 1, 1}})}});
    EXPECT_EQ(opaque.colors, (std::vector<glm::vec4>{{1, 0.5f, 0, 1}, {0, 0, 1, 1}, {0, 1, 1, 1}}));

    GltfBuilder four;
    const int bytes = addElements<uint8_t>(four, {255, 0, 51, 102, 0, 0, 0, 255, 255, 255, 255, 0}, "VEC4",
                                           {{"componentType", kUnsignedByte}, {"normalized", true}});
    EXPECT_EQ(importWith(four, {{"COLOR_0", bytes}}).colors,
              (std::vector<glm::vec4>{{1, 0, 0.2f, 0.4f}, {0, 0, 0, 1}, {1, 1, 1, 0}}));
}

TEST(GltfVertices, CoordinatesThatAreNotFiniteBecomeZeroWithAWarning) {
    GltfBuilder builder;
    const int uvs = addElements<glm::vec2>(builder, {{0, 1}, {HUGE_VALF, 0}, {0, 0}}, "VEC2",
                                           {{"componentType", kFloat}});
    EXPECT_EQ(importWith(builder, {{"TEXCOORD_0", uvs}}).uvs.at(0).at(1), glm::vec2(0.0f));
    EXPECT_EQ(warningsWith(builder.import(), "not finite were taken as 0: mesh 0 \"part\""), 1);
}

TEST(GltfVertices, AttributesOfAnotherTypeAreRefusedByName) {
    for (const char* attribute : {"TEXCOORD_0", "TANGENT", "COLOR_0"}) {
        GltfBuilder builder;
        const int scalars = addElements<float>(builder, {0, 0, 0}, "SCALAR", {{"componentType", kFloat}});
        const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        builder.addNode(
            {{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}, {attribute, scalars}}}})}});
        EXPECT_NE(importError(builder).find(std::string("is used as ") + attribute), std::string::npos)
            << importError(builder);
    }
}

TEST(GltfVertices, TangentsGoWithTheSurfaceAndKeepTheirBitangentInAMirror) {
    GltfBuilder builder;
    const int tangents = addElements<glm::vec4>(builder, std::vector<glm::vec4>(3, {3, 0, 0, 1}), "VEC4",
                                                {{"componentType", kFloat}});
    const Json attributes = {{"NORMAL", addUp(builder)}, {"TANGENT", tangents}};
    const Mesh mirrored = importWith(builder, attributes, {{"scale", {-2, 1, 1}}});
    ASSERT_EQ(mirrored.tangents.size(), 3u);
    const glm::vec4 tangent = mirrored.tangents[0];
    EXPECT_EQ(glm::vec3(tangent), glm::vec3(-1, 0, 0));
    // The file's bitangent is +y, which this scale leaves alone.
    EXPECT_EQ(tangent.w * glm::cross(mirrored.normals.at(0), glm::vec3(tangent)), glm::vec3(0, 1, 0));
}

TEST(GltfVertices, TangentsWithoutDirectionAreReplacedAndFlatMeshesHaveNone) {
    GltfBuilder builder;
    const int tangents = addElements<glm::vec4>(builder, {{0, 0, 0, 1}, {1, 0, 0, -1}, {1, 0, 0, 1}}, "VEC4",
                                                {{"componentType", kFloat}});
    const Mesh mesh = importWith(builder, {{"NORMAL", addUp(builder)}, {"TANGENT", tangents}});
    EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents.at(0))), 1.0f, 1e-6f);
    EXPECT_NEAR(mesh.tangents.at(0).z, 0.0f, 1e-6f);
    EXPECT_EQ(mesh.tangents.at(1), glm::vec4(1, 0, 0, -1));
    EXPECT_EQ(warningsWith(builder.import(), "1 tangents of no direction"), 1);

    GltfBuilder flat;
    const int unused = addElements<glm::vec4>(flat, std::vector<glm::vec4>(3, {1, 0, 0, 1}), "VEC4",
                                              {{"componentType", kFloat}});
    EXPECT_TRUE(importWith(flat, {{"TANGENT", unused}}).tangents.empty());
}

TEST(GltfVertices, VerticesLeaveWithAllTheirAttributes) {
    GltfBuilder builder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int positions = builder.addVec3({{nan, 0, 0}, {9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto numbered = [&](const char* type, size_t components) {
        std::vector<float> values;
        for (size_t vertex = 0; vertex < 5; ++vertex)
            values.insert(values.end(), components, static_cast<float>(vertex) / 4.0f);
        return builder.addAccessor({{"bufferView", builder.addView(values)},
                                    {"componentType", kFloat},
                                    {"count", 5},
                                    {"type", type}});
    };
    const int normals = builder.addVec3(std::vector<glm::vec3>(5, glm::vec3(0, 0, 1)));
    const int indices = builder.addIndices<uint8_t>({0, 2, 3, 2, 3, 4}, kUnsignedByte);
    builder.addNode({{"mesh", builder.addMesh({{"attributes",
                                                {{"POSITION", positions},
                                                 {"NORMAL", normals},
                                                 {"TEXCOORD_0", numbered("VEC2", 2)},
                                                 {"COLOR_0", numbered("VEC4", 4)},
                                                 {"TANGENT", numbered("VEC4", 4)}}},
                                               {"indices", indices}})}});
    const Mesh mesh = builder.import().meshes.at(0);
    ASSERT_EQ(mesh.positions.size(), 3u); // the unused vertex and the unusable triangle's have gone
    EXPECT_EQ(mesh.uvs.at(0), (std::vector<glm::vec2>{{0.5f, 0.5f}, {0.75f, 0.75f}, {1, 1}}));
    EXPECT_EQ(mesh.colors.at(1), glm::vec4(0.75f));
    EXPECT_EQ(mesh.colors.size(), 3u);
    EXPECT_EQ(mesh.tangents.size(), 3u);
}

// Textures of different transforms: of their own coordinates where tangents are generated, of the file's
// else.
TEST(GltfVertices, TangentsAreTheFilesOrThoseOfEachTexturesCoordinates) {
    GltfBuilder builder;
    builder.addNode({{"mesh", builder.addTriangle()}});
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["NORMAL"] = addUp(builder);
    primitive["attributes"]["TEXCOORD_0"] =
        addElements<glm::vec2>(builder, {{0, 1}, {1, 1}, {0, 0}}, "VEC2", {{"componentType", kFloat}});
    // 1 x 1 texel.
    builder.json["images"] = {
        {{"uri", "data:image/png;base64,"
                 "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGA"
                 "WjR9awAAAABJRU5ErkJggg=="}}};
    builder.json["textures"] = {{{"source", 0}}};
    const Json turned = {{"index", 0},
                         {"extensions", {{"KHR_texture_transform", {{"rotation", std::acos(-1.0) / 2.0}}}}}};
    builder.json["materials"] = {
        {{"normalTexture", {{"index", 0}}},
         {"extensions",
          {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", turned}}}}}}};
    const Mesh generated = builder.import().meshes.at(0);
    ASSERT_EQ(generated.tangents.size(), 3u);
    ASSERT_EQ(generated.furtherTangents.size(), 1u);
    EXPECT_NEAR(glm::length(generated.tangents[0] - glm::vec4(1, 0, 0, 1)), 0.0f, 1e-6f);
    // u' = v, which grows downwards.
    EXPECT_NEAR(glm::length(generated.furtherTangents[0][0] - glm::vec4(0, -1, 0, 1)), 0.0f, 1e-6f);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = addElements<glm::vec4>(
        builder, std::vector<glm::vec4>(3, {0, 1, 0, -1}), "VEC4", {{"componentType", kFloat}});
    const Mesh given = builder.import().meshes.at(0);
    EXPECT_EQ(given.tangents, std::vector<glm::vec4>(3, {0, 1, 0, -1}));
    EXPECT_TRUE(given.furtherTangents.empty());
}

} // namespace
} // namespace lavalight::test
