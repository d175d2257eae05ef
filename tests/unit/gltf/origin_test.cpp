// Scenes far from where the world's coordinates count from: whichever way they got there, their geometry,
// cameras and lights are as fine as near it, about an origin of their own.
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene_origin.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// A place whose coordinates single precision has in steps of 1 m, 2 m and 0.5 m.
const std::vector<double> kFar = {1e7, -2e7, 5e6};
const Json kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// Edges of single precision that no step of metres holds.
const std::vector<glm::vec3> kCorners = {{0.1f, 0.2f, 0.3f}, {1.1f, 0.2f, 0.3f}, {0.1f, 1.3f, 0.3f}};
// What a file can hold at that distance itself.
const std::vector<glm::vec3> kCoarseCorners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};

int addTriangle(GltfBuilder& builder, const std::vector<glm::vec3>& corners) {
    return builder.addMesh({{"attributes", {{"POSITION", builder.addVec3(corners)}}}});
}

int addNumbers(GltfBuilder& builder, const std::vector<float>& values, const char* type, size_t count) {
    return builder.addAccessor({{"bufferView", builder.addView(values)},
                                {"componentType", kFloat},
                                {"count", count},
                                {"type", type}});
}

// Adds a camera and a lamp, as children of the node or at the top.
void addViewAndLight(GltfBuilder& builder, std::optional<int> parent, const std::vector<double>& place) {
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    Json node = {{"camera", 0},
                 {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}},
                 {"translation", {place[0], place[1], place[2] + 3.1}}};
    const int number = builder.addNode(std::move(node));
    if (parent)
        builder.json["nodes"][static_cast<size_t>(*parent)]["children"].push_back(number);
}

// A place in the world, once it has been imported.
glm::dvec3 inWorld(const Scene& scene, const glm::vec3& position) {
    return scene.origin + glm::dvec3(position);
}

void expectAt(const glm::dvec3& place, const glm::dvec3& expected, const std::string& what) {
    EXPECT_LT(glm::length(place - expected), 1e-6)
        << what << ": " << place.x - expected.x << " " << place.y - expected.y << " " << place.z - expected.z;
}

// Corners, camera and lamp are where they would be, were single precision no limit.
void expectFine(const GltfBuilder& builder, const std::vector<glm::vec3>& corners, const std::string& way,
                const ImportOptions& options = {}) {
    const bool isFarInFile = way.ends_with("in the file");
    const Scene scene = importGltf("test.glb", builder.glb(), options);
    const glm::dvec3 far(kFar[0], kFar[1], kFar[2]);
    ASSERT_EQ(scene.meshes.size(), 1u) << way;
    for (size_t i = 0; i < 3; ++i)
        expectAt(inWorld(scene, scene.meshes[0].positions.at(i)), far + glm::dvec3(corners[i]), way);
    EXPECT_LT(glm::length(scene.meshes[0].positions[0]), 16.0f) << way;
    expectAt(inWorld(scene, scene.cameras.at(0).position), far + glm::dvec3(0, 0, 3.1), way + ", camera");
    expectAt(inWorld(scene, scene.punctualLights.at(0).position), far + glm::dvec3(0, 0, 3.1),
             way + ", lamp");
    EXPECT_FALSE(scene.coarse) << way;
    // Single precision has steps of 2 m for 20,000 km, which the file could not have but for whole metres.
    EXPECT_EQ(warningsWith(
                  scene, "positions 2e+07 m from their node are rounded to steps of 2 m by the file itself"),
              isFarInFile ? 1 : 0)
        << way;
    EXPECT_EQ(scene.warnings.size(), isFarInFile ? 1u : 0u) << way;
}

TEST(GltfOrigin, TranslationsAndMatricesAndNestedNodesMoveTheOriginAlong) {
    GltfBuilder translated;
    translated.addNode({{"translation", kFar}, {"children", {1}}});
    translated.addNode({{"mesh", addTriangle(translated, kCorners)}});
    addViewAndLight(translated, 0, {0, 0, 0});
    expectFine(translated, kCorners, "translation");

    GltfBuilder matrix = translated;
    matrix.json["nodes"][0].erase("translation");
    matrix.json["nodes"][0]["matrix"] = kIdentity;
    for (size_t axis = 0; axis < 3; ++axis)
        matrix.json["nodes"][0]["matrix"][12 + axis] = kFar[axis];
    expectFine(matrix, kCorners, "matrix");

    GltfBuilder nested; // too far, and back
    nested.addNode({{"translation", {3.0 * kFar[0], 3.0 * kFar[1], 3.0 * kFar[2]}}, {"children", {1}}});
    nested.addNode({{"translation", {-2.0 * kFar[0], -2.0 * kFar[1], -2.0 * kFar[2]}}, {"children", {2}}});
    nested.addNode({{"mesh", addTriangle(nested, kCorners)}});
    addViewAndLight(nested, 1, {0, 0, 0});
    expectFine(nested, kCorners, "nested nodes");
}

TEST(GltfOrigin, VerticesFarFromTheirNodeKeepWhatTheFileHolds) {
    GltfBuilder builder;
    std::vector<glm::vec3> corners;
    corners.reserve(kCoarseCorners.size());
    for (const glm::vec3& corner : kCoarseCorners)
        corners.push_back(corner + glm::vec3(kFar[0], kFar[1], kFar[2]));
    builder.addNode({{"mesh", addTriangle(builder, corners)}});
    addViewAndLight(builder, std::nullopt, kFar);
    expectFine(builder, kCoarseCorners, "vertices in the file");
}

TEST(GltfOrigin, InstancesMayBeFarFromTheirNode) {
    GltfBuilder builder;
    const int place = builder.addVec3({glm::vec3(kFar[0], kFar[1], kFar[2])});
    builder.addNode(
        {{"mesh", addTriangle(builder, kCorners)},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", place}}}}}}}});
    addViewAndLight(builder, std::nullopt, kFar);
    expectFine(builder, kCorners, "instances");
}

TEST(GltfOrigin, AnimationsMayBringNodesThere) {
    GltfBuilder builder;
    builder.addNode({{"children", {1}}});
    builder.addNode({{"mesh", addTriangle(builder, kCorners)}});
    addViewAndLight(builder, 0, {0, 0, 0});
    const int times = addNumbers(builder, {0.0f, 4.0f}, "SCALAR", 2);
    const int places = builder.addVec3({glm::vec3(0), 2.0f * glm::vec3(kFar[0], kFar[1], kFar[2])});
    builder.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    expectFine(builder, kCorners, "animation", {.seconds = 2.0});
    EXPECT_EQ(importGltf("test.glb", builder.glb(), {.seconds = 0.0}).origin, glm::dvec3(0.0));
}

// A skin whose vertices lie far from the model's own zero, and whose joints bring them back and there again.
TEST(GltfOrigin, SkinsOfFarJointsAreAsFine) {
    for (const bool isFarInFile : {false, true}) {
        const glm::vec3 far(kFar[0], kFar[1], kFar[2]);
        const std::vector<glm::vec3>& corners = isFarInFile ? kCoarseCorners : kCorners;
        std::vector<glm::vec3> stored;
        stored.reserve(corners.size());
        for (const glm::vec3& corner : corners)
            stored.push_back(isFarInFile ? corner + far : corner);
        GltfBuilder builder;
        const int joints = builder.addAccessor(
            {{"bufferView", builder.addView<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0})},
             {"componentType", kUnsignedByte},
             {"count", 3},
             {"type", "VEC4"}});
        const int weights = addNumbers(builder, {.3f, .7f, 0, 0, .4f, .6f, 0, 0, .1f, .9f, 0, 0}, "VEC4", 3);
        std::vector<float> inverse;
        for (int joint = 0; joint < 2; ++joint)
            for (size_t i = 0; i < 16; ++i)
                inverse.push_back(isFarInFile && i >= 12 && i < 15 ? -far[static_cast<glm::length_t>(i - 12)]
                                                                   : kIdentity[i].get<float>());
        const int mesh = builder.addMesh(
            {{"attributes",
              {{"POSITION", builder.addVec3(stored)}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}});
        builder.addNode({{"mesh", mesh}, {"skin", 0}});
        builder.addNode({{"translation", kFar}});
        builder.addNode({{"translation", kFar}});
        builder.json["skins"] = {
            {{"joints", {1, 2}}, {"inverseBindMatrices", addNumbers(builder, inverse, "MAT4", 2)}}};
        addViewAndLight(builder, std::nullopt, kFar);
        expectFine(builder, corners, isFarInFile ? "skin, far in the file" : "skin");
    }
}

// A tenth of a metre is lost where coordinates are steps of 1 m, unless targets are added nearer to zero.
TEST(GltfOrigin, MorphTargetsMoveVerticesByLessThanTheirStepsInTheFile) {
    std::vector<glm::vec3> corners;
    corners.reserve(kCoarseCorners.size());
    for (const glm::vec3& corner : kCoarseCorners)
        corners.push_back(corner + glm::vec3(kFar[0], kFar[1], kFar[2]));
    GltfBuilder builder;
    const int moves = builder.addVec3({{0.1f, 0.2f, 0.3f}, {0.1f, 0.2f, 0.3f}, {0.1f, 0.2f, 0.3f}});
    const int mesh = builder.addMesh(
        {{"attributes", {{"POSITION", builder.addVec3(corners)}}}, {"targets", {{{"POSITION", moves}}}}});
    builder.json["meshes"][static_cast<size_t>(mesh)]["weights"] = {1.0};
    builder.addNode({{"mesh", mesh}});
    addViewAndLight(builder, std::nullopt, kFar);
    expectFine(builder, {{0.1f, 0.2f, 0.3f}, {2.1f, 0.2f, 0.3f}, {0.1f, 2.2f, 0.3f}},
               "morph, far in the file");
}

TEST(GltfOrigin, StaysAtZeroWhereNothingIsGained) {
    for (const double away : {0.0, 1.0, 30.0}) {
        GltfBuilder builder;
        builder.addNode({{"translation", {away, -away, 0}}, {"children", {1}}});
        builder.addNode({{"mesh", addTriangle(builder, kCorners)}});
        addViewAndLight(builder, 0, {0, 0, 0});
        const Scene scene = builder.import();
        EXPECT_EQ(scene.origin, glm::dvec3(0.0)) << away;
    }
    GltfBuilder aside; // far on one axis alone
    aside.addNode({{"mesh", addTriangle(aside, kCorners)}, {"translation", {0, 0, 1e6}}});
    const glm::dvec3 origin = aside.import().origin;
    EXPECT_EQ(origin.x, 0.0);
    EXPECT_EQ(origin.y, 0.0);
    EXPECT_NEAR(origin.z, 1e6, 2.0);
}

// Two triangles 10,000 km apart, with a camera before the first one and one before the second.
GltfBuilder apart() {
    GltfBuilder builder;
    const int mesh = addTriangle(builder, kCorners);
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"name", "here"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}},
        {{"type", "perspective"}, {"name", "there"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    builder.addNode({{"mesh", mesh}});
    builder.addNode({{"mesh", mesh}, {"translation", {1e7, 0, 0}}});
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 3}}});
    builder.addNode({{"camera", 1}, {"translation", {1e7, 0, 3}}});
    return builder;
}

TEST(GltfOrigin, IsNearTheCameraThatTheSceneIsSeenFrom) {
    const std::string bytes = apart().glb();
    EXPECT_EQ(importGltf("test.glb", bytes).origin, glm::dvec3(0.0));
    EXPECT_NEAR(importGltf("test.glb", bytes, {.camera = "there"}).origin.x, 1e7, 4.0);
    EXPECT_NEAR(importGltf("test.glb", bytes, {.camera = "1"}).origin.x, 1e7, 4.0);
    EXPECT_NEAR(importGltf("test.glb", bytes, {.viewpoint = glm::dvec3(1e7, 5, 5)}).origin.x, 1e7, 8.0);
    EXPECT_THROW(static_cast<void>(importGltf("test.glb", bytes, {.camera = "nowhere"})), UsageError);
}

TEST(GltfOrigin, WhatLiesTooFarApartIsWarnedOfWithItsFigures) {
    const Scene scene = apart().import();
    ASSERT_TRUE(scene.coarse);
    EXPECT_EQ(scene.coarse->resolution, 1.0);
    EXPECT_NEAR(scene.coarse->distance, 1e7, 2.0);
    EXPECT_NEAR(scene.coarse->size, 1.1, 1e-6);
    EXPECT_EQ(warningsWith(scene, "1e+07 m from this scene's origin, (0, 0, 0), positions are rounded to "
                                  "steps of 1 m, too coarse for what is 1.1 m wide"),
              1);
    EXPECT_EQ(warningsWith(scene, "mesh 0 \"part\""), 1);
}

// One primitive holds both, and its box says nothing of what is small in it.
TEST(GltfOrigin, OnePrimitiveMayLieTooFarApartInItself) {
    std::vector<glm::vec3> corners = kCoarseCorners;
    for (const glm::vec3& corner : kCoarseCorners)
        corners.push_back(corner + glm::vec3(1e7f, 0, 0));
    GltfBuilder builder;
    builder.addNode({{"mesh", addTriangle(builder, corners)}});
    addViewAndLight(builder, std::nullopt, {1e7, 0, 0});
    const Scene scene = builder.import();
    EXPECT_NEAR(scene.origin.x, 1e7, 8.0);
    ASSERT_TRUE(scene.coarse);
    EXPECT_EQ(scene.coarse->resolution, 1.0);
}

TEST(GltfOrigin, ResolutionIsTheStepOfSinglePrecision) {
    for (const float at : {1.0f, 1.5f, 1e7f, 3e-4f, 2e12f})
        EXPECT_EQ(resolutionAt(at), std::nextafter(at, 1e30f) - at) << at;
    EXPECT_EQ(resolutionAt(0.0), 0.0);
}

} // namespace
} // namespace lavalight::test
