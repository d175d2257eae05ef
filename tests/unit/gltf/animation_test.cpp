// Tests of animations: what lies between keys, what a channel moves, which animation is meant.
#include <cmath>
#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

template <class T>
int addFloats(GltfBuilder& builder, const std::vector<T>& values, const char* type) {
    return builder.addAccessor({{"bufferView", builder.addView(values)},
                                {"componentType", kFloat},
                                {"count", values.size()},
                                {"type", type}});
}

// The triangle in one node, and an animation of one channel on it.
struct Moving {
    GltfBuilder builder;

    Moving(const std::string& path, const std::string& interpolation, const std::vector<float>& times,
           const std::function<int(GltfBuilder&)>& addValues) {
        builder.addNode({{"mesh", builder.addTriangle()}});
        const int input = addFloats(builder, times, "SCALAR");
        const Json sampler = {
            {"input", input}, {"output", addValues(builder)}, {"interpolation", interpolation}};
        builder.json["animations"] = {
            {{"name", "move"},
             {"samplers", Json::array({sampler})},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
    }

    [[nodiscard]] Scene at(std::optional<double> seconds, const std::string& animation = "") const {
        return importGltf("test.glb", builder.glb(), {.seconds = seconds, .animation = animation});
    }
    // Where the corner (1, 0, 0) is at that time.
    [[nodiscard]] glm::vec3 corner(double seconds) const { return at(seconds).meshes.at(0).positions.at(1); }
};

Moving sliding(const std::string& interpolation) {
    return {"translation", interpolation, {1.0f, 3.0f}, [](GltfBuilder& builder) {
                return builder.addVec3({{0, 0, 0}, {8, 0, 4}});
            }};
}

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_NEAR(glm::length(a - b), 0.0f, 1e-5f) << a.x << " " << a.y << " " << a.z;
}

TEST(GltfAnimation, LinearKeysAreMixedAndTheOutermostHold) {
    const Moving moving = sliding("LINEAR");
    expectNear(moving.corner(-1.0), {1, 0, 0});
    expectNear(moving.corner(1.0), {1, 0, 0});
    expectNear(moving.corner(1.5), {3, 0, 1});
    expectNear(moving.corner(3.0), {9, 0, 4});
    expectNear(moving.corner(99.0), {9, 0, 4});
}

TEST(GltfAnimation, StepsHoldUntilTheNextKey) {
    const Moving moving = sliding("STEP");
    expectNear(moving.corner(2.999), {1, 0, 0});
    expectNear(moving.corner(3.0), {9, 0, 4});
}

TEST(GltfAnimation, WithoutATimeNodesStayWhereTheFilePlacesThem) {
    const Scene scene = sliding("LINEAR").at(std::nullopt);
    expectNear(scene.meshes.at(0).positions.at(1), {1, 0, 0});
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0].name, "move");
    EXPECT_EQ(scene.animations[0].seconds, 3.0f);
    EXPECT_EQ(warningsWith(scene, "animation"), 0);
}

TEST(GltfAnimation, CubicSplineOfACubicIsThatCubic) {
    // x(t) = t^3 - 2 t on [0, 2], y = t^2: Hermite's interpolation is exact for both.
    const Moving moving("translation", "CUBICSPLINE", {0.0f, 2.0f}, [](GltfBuilder& builder) {
        const glm::vec3 unused(77);
        return builder.addVec3({unused, {0, 0, 0}, {-2, 0, 0}, {10, 4, 0}, {4, 4, 0}, unused});
    });
    for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
        const auto x = static_cast<float>(t * t * t - 2.0 * t);
        expectNear(moving.corner(t), {1.0f + x, static_cast<float>(t * t), 0});
    }
}

TEST(GltfAnimation, RotationsGoTheShorterWayAtConstantSpeed) {
    const float half = std::sqrt(0.5f);
    // A quarter turn about z; the second key is stored as its negative, which is the same rotation.
    const Moving moving("rotation", "LINEAR", {0.0f, 1.0f}, [half](GltfBuilder& builder) {
        return addFloats<glm::vec4>(builder, {{0, 0, 0, 1}, {0, 0, -half, -half}}, "VEC4");
    });
    for (const double t : {0.0, 1.0 / 3.0, 1.0}) {
        const double angle = t * 1.5707963267948966;
        expectNear(moving.corner(t),
                   {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    }
}

TEST(GltfAnimation, RotationsMayBeNormalizedShorts) {
    const Moving moving("rotation", "STEP", {0.0f}, [](GltfBuilder& builder) {
        return builder.addAccessor({{"bufferView", builder.addView<int16_t>({0, 0, 32767, 0})},
                                    {"componentType", kShort},
                                    {"normalized", true},
                                    {"count", 1},
                                    {"type", "VEC4"}});
    });
    expectNear(moving.corner(0.0), {-1, 0, 0});
}

TEST(GltfAnimation, ScaleMovesOnlyWhatTheChannelNames) {
    Moving moving("scale", "LINEAR", {0.0f, 1.0f}, [](GltfBuilder& builder) {
        return builder.addVec3({{1, 1, 1}, {3, 1, 1}});
    });
    moving.builder.json["nodes"][0]["translation"] = {0, 5, 0};
    expectNear(moving.corner(0.5), {2, 5, 0});
}

std::string usageError(const Moving& moving, const std::string& animation) {
    try {
        static_cast<void>(moving.at(0.0, animation));
    } catch (const UsageError& error) {
        return error.what();
    }
    return {};
}

TEST(GltfAnimation, IsFoundByNameOrIndexAndUnknownOnesGetTheList) {
    const Moving moving = sliding("LINEAR");
    EXPECT_EQ(usageError(moving, "move"), "");
    EXPECT_EQ(usageError(moving, "0"), "");
    EXPECT_EQ(usageError(moving, "1"), "--animation: test.glb has no animation \"1\"; it has 0 \"move\"");
    Moving still = sliding("LINEAR");
    still.builder.json.erase("animations");
    EXPECT_EQ(usageError(still, ""), "test.glb has no animation that a time could be asked of");
}

std::string errorAt(const Moving& moving) {
    try {
        static_cast<void>(moving.at(0.5));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(GltfAnimation, KeysThatAreNoAnimationAreRefusedWhereTheyAreAskedFor) {
    const auto three = [](GltfBuilder& builder) { return builder.addVec3(std::vector<glm::vec3>(3)); };
    const Moving short_("translation", "LINEAR", {0.0f, 1.0f}, three);
    EXPECT_NE(errorAt(short_).find("has 3 elements for 2 times"), std::string::npos) << errorAt(short_);
    EXPECT_EQ(short_.at(std::nullopt).triangleCount(), 1u);
    const Moving back("translation", "LINEAR", {1.0f, 0.0f, 2.0f}, three);
    EXPECT_NE(errorAt(back).find("must ascend, but 0 follows 1"), std::string::npos) << errorAt(back);
    const Moving wrong("rotation", "LINEAR", {0.0f, 1.0f, 2.0f}, three);
    EXPECT_NE(errorAt(wrong).find("of another type"), std::string::npos) << errorAt(wrong);
    Moving lost = sliding("LINEAR");
    lost.builder.json["animations"][0]["channels"][0]["sampler"] = 4;
    EXPECT_NE(errorAt(lost).find("animation 0 \"move\" has 1 samplers"), std::string::npos) << errorAt(lost);
}

TEST(GltfMorph, TargetsAreAddedByTheirWeightsAndNormalsFollow) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normals = builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    const int up = builder.addVec3({{0, 0, 0}, {0, 0, 4}, {0, 0, 0}});
    const int aside = builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(2, 0, 0)));
    const int mesh = builder.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                      {"targets", {{{"POSITION", up}}, {{"NORMAL", aside}}}}});
    builder.addNode({{"mesh", mesh}});
    builder.addNode({{"mesh", mesh}, {"weights", {0.5, 0.5}}});
    builder.json["meshes"][0]["weights"] = {0.25, 0};
    const Scene scene = builder.import();
    ASSERT_EQ(scene.meshes.size(), 2u);
    expectNear(scene.meshes[0].positions.at(1), {1, 0, 1});
    expectNear(scene.meshes[0].normals.at(1), {0, 0, 1});
    expectNear(scene.meshes[1].positions.at(1), {1, 0, 2});
    expectNear(scene.meshes[1].normals.at(1), glm::normalize(glm::vec3(1, 0, 1)));
}

TEST(GltfMorph, AnimatedWeightsReplaceThoseOfTheFile) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int up = builder.addVec3({{0, 0, 0}, {0, 0, 4}, {0, 0, 0}});
    const int mesh = builder.addMesh(
        {{"attributes", {{"POSITION", positions}}}, {"targets", {{{"POSITION", up}}, Json::object()}}});
    builder.addNode({{"mesh", mesh}, {"weights", {9, 9}}});
    const int input = addFloats<float>(builder, {0, 1}, "SCALAR");
    const int output = addFloats<float>(builder, {0, 7, 1, 7}, "SCALAR"); // two weights a key
    builder.json["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    const Scene scene = importGltf("test.glb", builder.glb(), {.seconds = 0.25});
    expectNear(scene.meshes.at(0).positions.at(1), {1, 0, 1});
}

// Colours of three and of four components; what leaves [0, 1] is cut.
TEST(GltfMorph, ColoursAreMovedAndClamped) {
    for (const bool hasAlpha : {false, true}) {
        GltfBuilder builder;
        const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        const int colors = builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(0.5f)));
        const int brighter =
            hasAlpha ? addFloats<glm::vec4>(builder, std::vector<glm::vec4>(3, {0.5, -2, 0, -1}), "VEC4")
                     : builder.addVec3(std::vector<glm::vec3>(3, {0.5, -2, 0}));
        const int mesh = builder.addMesh({{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}},
                                          {"targets", {{{"COLOR_0", brighter}}}}});
        builder.addNode({{"mesh", mesh}, {"weights", {0.5}}});
        const Scene scene = builder.import();
        EXPECT_EQ(scene.meshes.at(0).colors.at(2), glm::vec4(0.75f, 0.0f, 0.5f, hasAlpha ? 0.5f : 1.0f));
    }
}

// glTF 2.0, 3.7.2.2: base + sum of weight * target, and colours are clamped once, after all of them: 0.5 +
// 1 - 0.75 is 0.75, whatever of it leaves [0, 1] on the way, and so for bases and weights that do.
TEST(GltfMorph, ColoursAreClampedAfterAllTargets) {
    const auto morphed = [](float base, float first, float second, const Json& weights) {
        GltfBuilder builder;
        const auto grey = [&](float v) { return builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(v))); };
        const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        const int colors = grey(base);
        const int mesh =
            builder.addMesh({{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}},
                             {"targets", {{{"COLOR_0", grey(first)}}, {{"COLOR_0", grey(second)}}}}});
        builder.addNode({{"mesh", mesh}, {"weights", weights}});
        return builder.import().meshes.at(0).colors.at(1).x;
    };
    EXPECT_EQ(morphed(0.5f, 1.0f, -0.75f, {1, 1}), 0.75f);
    EXPECT_EQ(morphed(0.5f, -1.0f, 0.75f, {1, 1}), 0.25f);
    EXPECT_EQ(morphed(1.5f, -0.75f, 0.0f, {1, 0}), 0.75f); // the base, too
    EXPECT_EQ(morphed(-0.5f, 0.75f, 0.0f, {1, 0}), 0.25f);
    EXPECT_EQ(morphed(0.5f, 1.0f, 1.0f, {3, -2.75}), 0.75f); // weights that add up to other than 1
    EXPECT_EQ(morphed(0.5f, 1.0f, 1.0f, {1, 1}), 1.0f);
    EXPECT_EQ(morphed(1.5f, 1.0f, 1.0f, {0, 0}), 1.0f);
}

// Coordinates of a texture that repeats may leave [0, 1]; tangents get their length once, after all targets.
TEST(GltfMorph, CoordinatesAndTangentsAreSumsOfAllTargets) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normals = builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    const auto uvs = [&](glm::vec2 uv) {
        return addFloats<glm::vec2>(builder, std::vector<glm::vec2>(3, uv), "VEC2");
    };
    const int tangents = addFloats<glm::vec4>(builder, std::vector<glm::vec4>(3, {1, 0, 0, -1}), "VEC4");
    const int base = uvs({0.5f, 0.5f});
    const int first = uvs({3.0f, -2.0f});
    const int second = uvs({-1.0f, 1.0f});
    const int aside = builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(3, 4, 0)));
    const int back = builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(-1, 0, 0)));
    const int mesh = builder.addMesh(
        {{"attributes",
          {{"POSITION", positions}, {"NORMAL", normals}, {"TANGENT", tangents}, {"TEXCOORD_0", base}}},
         {"targets",
          {{{"TEXCOORD_0", first}, {"TANGENT", aside}}, {{"TEXCOORD_0", second}, {"TANGENT", back}}}}});
    builder.addNode({{"mesh", mesh}, {"weights", {1, 1}}});
    const Mesh morphed = builder.import().meshes.at(0);
    EXPECT_EQ(morphed.uvs.at(0).at(1), glm::vec2(2.5f, -0.5f));
    expectNear(glm::vec3(morphed.tangents.at(1)), {0.6f, 0.8f, 0}); // (1, 0) + (3, 4) - (1, 0)
    EXPECT_EQ(morphed.tangents.at(1).w, -1.0f);
}

TEST(GltfMorph, CoordinatesThatATargetMakesInfiniteAreTakenAsZeroWithAWarning) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int base = addFloats<glm::vec2>(builder, std::vector<glm::vec2>(3, glm::vec2(1.0f)), "VEC2");
    const int far = addFloats<glm::vec2>(builder, std::vector<glm::vec2>(3, glm::vec2(3e38f)), "VEC2");
    const int mesh = builder.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", base}}},
                                      {"targets", {{{"TEXCOORD_0", far}}}}});
    builder.addNode({{"mesh", mesh}, {"weights", {9}}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.meshes.at(0).uvs.at(0).at(0), glm::vec2(0.0f));
    EXPECT_EQ(warningsWith(scene, "texture coordinates that are not finite"), 1);
}

TEST(GltfMorph, TargetsOfAnotherSizeOrTypeAreRefused) {
    GltfBuilder flat;
    const int corners = flat.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int pairs = addFloats<glm::vec2>(flat, std::vector<glm::vec2>(3), "VEC2");
    flat.addNode({{"mesh", flat.addMesh({{"attributes", {{"POSITION", corners}}},
                                         {"targets", {{{"POSITION", pairs}}}}})},
                  {"weights", {1}}});
    EXPECT_NE(importError(flat).find("is used as POSITION of a morph target and must be a VEC3"),
              std::string::npos);
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int few = builder.addVec3({{0, 0, 0}});
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}}},
                                               {"targets", {{{"POSITION", few}}}}})},
                     {"weights", {1}}});
    EXPECT_NE(importError(builder).find("has 1 elements, too few for vertex 1"), std::string::npos);
}

// The triangle with one joint a vertex; the joints are nodes 1 and 2, the mesh's own node is far away.
GltfBuilder skinned(const Json& firstJoint, const Json& secondJoint) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normals = builder.addVec3(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    const int joints = builder.addAccessor({{"bufferView", builder.addView<uint8_t>({0, 0, 0, 0, //
                                                                                     1, 0, 0, 0, //
                                                                                     0, 1, 0, 0})},
                                            {"componentType", kUnsignedByte},
                                            {"count", 3},
                                            {"type", "VEC4"}});
    const int weights =
        addFloats<glm::vec4>(builder, {{1, 0, 0, 0}, {1, 0, 0, 0}, {0.25f, 0.25f, 0, 0}}, "VEC4");
    const int mesh = builder.addMesh(
        {{"attributes",
          {{"POSITION", positions}, {"NORMAL", normals}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}});
    builder.addNode({{"mesh", mesh}, {"skin", 0}, {"translation", {100, 0, 0}}});
    builder.addNode(firstJoint);
    builder.addNode(secondJoint);
    builder.json["skins"] = {{{"joints", {1, 2}}}};
    return builder;
}

TEST(GltfSkin, VerticesFollowTheMeanOfTheirJointsAndNotTheirNode) {
    const Scene scene = skinned(Json::object(), {{"translation", {0, 0, 4}}}).import();
    const Mesh& mesh = scene.meshes.at(0);
    expectNear(mesh.positions.at(0), {0, 0, 0});
    expectNear(mesh.positions.at(1), {1, 0, 4});
    expectNear(mesh.positions.at(2), {0, 1, 2}); // weights that add up to a half are brought to 1
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfSkin, InverseBindMatricesComeFirst) {
    GltfBuilder builder = skinned(Json::object(), {{"translation", {0, 0, 4}}, {"scale", {3, 3, 3}}});
    std::vector<glm::mat4> matrices(2, glm::mat4(1.0f));
    matrices[1][3] = {-1, 0, 0, 1}; // the second joint was bound at (1, 0, 0)
    builder.json["skins"][0]["inverseBindMatrices"] = addFloats(builder, matrices, "MAT4");
    expectNear(builder.import().meshes.at(0).positions.at(1), {0, 0, 4});
}

TEST(GltfSkin, NormalsGoWithTheInverseTransposeOfTheirJoints) {
    const double half = std::sqrt(0.5);
    // Half a quarter turn of the normal about y, then squeezed along z by 1/2: slopes double.
    GltfBuilder builder = skinned({{"scale", {1, 1, 0.5}}, {"children", {3}}}, Json::object());
    builder.addNode({{"rotation", {0, std::sin(0.39269908169872414), 0, std::cos(0.39269908169872414)}}});
    builder.json["skins"][0]["joints"] = {3, 2};
    const glm::vec3 normal = builder.import().meshes.at(0).normals.at(0);
    const auto expected = glm::normalize(glm::dvec3(half, 0.0, 2.0 * half));
    expectNear(normal, glm::vec3(expected));
}

TEST(GltfSkin, MirroringJointsKeepFrontsCounterClockwise) {
    const Json mirror = {{"scale", {-1, 1, 1}}};
    const Scene scene = skinned(mirror, mirror).import();
    expectNear(frontOf(scene.meshes.at(0), 0), {0, 0, 1});
    expectNear(scene.meshes.at(0).normals.at(0), {0, 0, 1});
}

TEST(GltfSkin, JointsThatTheSkinLacksAndShortMatricesAreRefused) {
    GltfBuilder one = skinned(Json::object(), Json::object());
    one.json["skins"][0]["joints"] = {1};
    EXPECT_NE(importError(one).find("names joint 1 of a skin that has 1"), std::string::npos);
    GltfBuilder few = skinned(Json::object(), Json::object());
    few.json["skins"][0]["inverseBindMatrices"] =
        addFloats(few, std::vector<glm::mat4>(1, glm::mat4(1.0f)), "MAT4");
    EXPECT_NE(importError(few).find("skin 0 needs 2 MAT4s"), std::string::npos);
}

} // namespace
} // namespace lavalight::test
