// Tests of lights without size: what a file says of them, where its nodes put them, and how bad ones fail.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

constexpr const char* kExtension = "KHR_lights_punctual";

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_NEAR(glm::length(a - b), 0.0f, 1e-6f) << a.x << " " << a.y << " " << a.z;
}

// A triangle beside `light`, which `node` carries.
GltfBuilder fileWith(Json light, Json node = Json::object()) {
    GltfBuilder builder;
    builder.addNode({{"mesh", builder.addTriangle()}});
    builder.json["extensions"][kExtension]["lights"] = Json::array({std::move(light)});
    node["extensions"][kExtension]["light"] = 0;
    builder.addNode(std::move(node));
    return builder;
}

PunctualLight importLight(Json light, Json node = Json::object()) {
    return fileWith(std::move(light), std::move(node)).import().punctualLights.at(0);
}

Json spotOf(const Json& cone) {
    return {{"type", "spot"}, {"spot", cone}};
}

TEST(GltfLight, PointLightStandsAtItsNode) {
    const PunctualLight light =
        importLight({{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0.25}}, {"intensity", 40}},
                    {{"translation", {1, 2, 3}}});
    EXPECT_EQ(light.name, "bulb");
    EXPECT_EQ(light.kind, PunctualKind::point);
    EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(light.intensity, glm::vec3(40, 20, 10));
}

TEST(GltfLight, DirectionalLightShinesAlongMinusZOfItsNode) {
    const float half = std::sqrt(0.5f); // 90 degrees about y: -z becomes -x
    const PunctualLight light =
        importLight({{"type", "directional"}, {"intensity", 2.5}}, {{"rotation", {0, half, 0, half}}});
    EXPECT_EQ(light.kind, PunctualKind::directional);
    EXPECT_EQ(light.intensity, glm::vec3(2.5f));
    expectNear(light.direction, {-1, 0, 0});
}

TEST(GltfLight, SpotLightHasACone) {
    const PunctualLight light = importLight(spotOf({{"innerConeAngle", 0.25}, {"outerConeAngle", 0.35}}),
                                            {{"translation", {0, 5, 0}}});
    EXPECT_EQ(light.kind, PunctualKind::spot);
    EXPECT_FLOAT_EQ(light.innerConeAngle, 0.25f);
    EXPECT_FLOAT_EQ(light.outerConeAngle, 0.35f);
    expectNear(light.direction, {0, 0, -1});
    expectNear(light.position, {0, 5, 0});
}

TEST(GltfLight, DefaultsAreThoseOfTheExtension) {
    const PunctualLight light = importLight(spotOf(Json::object()));
    EXPECT_EQ(light.intensity, glm::vec3(1.0f));
    EXPECT_EQ(light.innerConeAngle, 0.0f);
    EXPECT_FLOAT_EQ(light.outerConeAngle, std::numbers::pi_v<float> / 4.0f);
}

TEST(GltfLight, ScalesMoveALightButDoNotChangeIt) {
    GltfBuilder builder =
        fileWith(spotOf(Json::object()), {{"translation", {1, 0, 0}}, {"scale", {5, 7, 3}}});
    builder.addNode({{"children", {1}}, {"scale", {2, 2, 2}}});
    const PunctualLight light = builder.import().punctualLights.at(0);
    expectNear(light.position, {2, 0, 0});
    expectNear(light.direction, {0, 0, -1});
    EXPECT_EQ(light.intensity, glm::vec3(1.0f));
}

TEST(GltfLight, RangeIsOfPointsAndSpots) {
    EXPECT_EQ(importLight({{"type", "point"}, {"range", 0.25}}).range, 0.25f);
    EXPECT_EQ(importLight({{"type", "spot"}, {"spot", Json::object()}, {"range", 7}}).range, 7.0f);
    EXPECT_EQ(importLight({{"type", "directional"}, {"range", 7}}).range, kNoRange);
    EXPECT_EQ(importLight({{"type", "point"}}).range, kNoRange);
    EXPECT_EQ(importLight({{"type", "point"}, {"range", 1e300}}).range, kNoRange);
    // Scales are not the light's (KHR_lights_punctual, "Light Types").
    EXPECT_EQ(importLight({{"type", "point"}, {"range", 2}}, {{"scale", {3, 3, 3}}}).range, 2.0f);
}

TEST(GltfLight, RangesThatAreNotAboveZeroAreLeftOutWithAWarningThatNamesTheLight) {
    for (const double range : {0.0, -1.0}) {
        const Scene scene = fileWith({{"type", "point"}, {"name", "odd"}, {"range", range}}).import();
        EXPECT_EQ(scene.punctualLights.at(0).range, kNoRange);
        EXPECT_EQ(warningsWith(scene, "not above 0 were left out: light 0 \"odd\""), 1);
    }
}

TEST(GltfLight, EachNodeOfTheShownSceneCarriesALightOfItsOwn) {
    GltfBuilder builder = fileWith({{"type", "point"}}, {{"name", "near"}});
    builder.addNode({{"name", "far"}, {"translation", {9, 0, 0}}});
    builder.json["nodes"][2]["extensions"][kExtension]["light"] = 0;
    const Scene both = builder.import();
    ASSERT_EQ(both.punctualLights.size(), 2u);
    EXPECT_EQ(both.punctualLights[0].name, "near"); // the node's name where the light has none
    EXPECT_EQ(both.punctualLights[1].name, "far");
    EXPECT_EQ(both.punctualLights[1].position, glm::vec3(9, 0, 0));
    builder.json["scenes"] = {{{"nodes", {0, 2}}}};
    EXPECT_EQ(builder.import().punctualLights.size(), 1u);
}

TEST(GltfLight, LitSceneKeepsItsDarkSurroundings) {
    const Scene lit = fileWith({{"type", "directional"}}).import();
    EXPECT_EQ(lit.environment, glm::vec3(0.0f));
    EXPECT_EQ(lit.warnings, std::vector<std::string>());
}

TEST(GltfLight, LightThatIsOffOrInNoNodeIsNoLight) {
    GltfBuilder builder = fileWith({{"type", "point"}, {"intensity", 0}});
    EXPECT_EQ(builder.import().environment, glm::vec3(1.0f));
    EXPECT_FALSE(builder.import().hasOwnLight);
    builder = fileWith({{"type", "point"}});
    builder.json["nodes"][1].erase("extensions");
    EXPECT_EQ(builder.import().environment, glm::vec3(1.0f));
}

TEST(GltfLight, FactorsOutOfRangeAreClampedWithAWarningThatNamesTheLight) {
    const Scene scene =
        fileWith({{"type", "point"}, {"name", "odd"}, {"color", {2, -1, 0.5}}, {"intensity", 8}}).import();
    EXPECT_EQ(scene.punctualLights.at(0).intensity, glm::vec3(8, 0, 4));
    EXPECT_EQ(warningsWith(scene, "color was clamped to 0 .. 1: light 0 \"odd\""), 1);
    const Scene negative = fileWith({{"type", "point"}, {"intensity", -5}}).import();
    EXPECT_EQ(negative.punctualLights.at(0).intensity, glm::vec3(0.0f));
    EXPECT_EQ(warningsWith(negative, "intensity was clamped"), 1);
    const Scene huge = fileWith({{"type", "point"}, {"intensity", 1e300}}).import();
    EXPECT_TRUE(std::isfinite(huge.punctualLights.at(0).intensity.x));
}

TEST(GltfLight, ConesOutOfRangeAreClampedWithAWarningThatNamesTheLight) {
    const Scene wide = fileWith(spotOf({{"innerConeAngle", -1}, {"outerConeAngle", 2}})).import();
    EXPECT_EQ(wide.punctualLights.at(0).innerConeAngle, 0.0f);
    EXPECT_FLOAT_EQ(wide.punctualLights.at(0).outerConeAngle, std::numbers::pi_v<float> / 2.0f);
    EXPECT_EQ(warningsWith(wide, "outerConeAngle was clamped to 0 .. 1.57"), 1);
    EXPECT_EQ(warningsWith(wide, "innerConeAngle was clamped to 0 .. outerConeAngle: light 0"), 1);
    const Scene crossed = fileWith(spotOf({{"innerConeAngle", 1}, {"outerConeAngle", 0.35}})).import();
    EXPECT_EQ(crossed.punctualLights.at(0).innerConeAngle, crossed.punctualLights.at(0).outerConeAngle);
    EXPECT_EQ(warningsWith(crossed, "innerConeAngle"), 1);
}

TEST(GltfLight, ConesAtTheEndsOfTheirRangeAreTakenAsTheyAre) {
    for (const double outer : {0.35, std::numbers::pi / 2.0}) {
        const Scene scene = fileWith(spotOf({{"innerConeAngle", outer}, {"outerConeAngle", outer}})).import();
        EXPECT_EQ(scene.punctualLights.at(0).innerConeAngle, static_cast<float>(outer));
        EXPECT_EQ(scene.warnings, std::vector<std::string>());
    }
}

TEST(GltfLight, UnknownTypeIsLeftOutWithAWarning) {
    const Scene scene = fileWith({{"type", "laser"}, {"name", "red"}}).import();
    EXPECT_TRUE(scene.punctualLights.empty());
    EXPECT_EQ(warningsWith(scene, "unknown type were left out: light 0 \"red\""), 1);
}

TEST(GltfLight, LightWithoutThePlaceOrDirectionThatItNeedsIsLeftOutWithAWarning) {
    const Json flat = {{"scale", {1, 1, 0}}};
    const Json away = {{"translation", {1e30, 0, 0}}};
    EXPECT_EQ(fileWith({{"type", "point"}}, flat).import().punctualLights.size(), 1u);
    EXPECT_EQ(fileWith({{"type", "directional"}}, away).import().punctualLights.size(), 1u);
    for (const GltfBuilder& builder :
         {fileWith(spotOf(Json::object()), flat), fileWith({{"type", "directional"}}, flat),
          fileWith({{"type", "point"}}, away), fileWith(spotOf(Json::object()), away)}) {
        const Scene scene = builder.import();
        EXPECT_TRUE(scene.punctualLights.empty());
        EXPECT_EQ(warningsWith(scene, "without a place or a direction were left out: light 0"), 1);
    }
}

TEST(GltfLight, ExtensionWithoutLightsIsTolerated) {
    GltfBuilder builder;
    builder.addNode({{"mesh", builder.addTriangle()}});
    builder.json["extensionsUsed"] = {kExtension};
    builder.json["extensionsRequired"] = {kExtension};
    for (const Json& extension : {Json(nullptr), Json::object(), Json{{"lights", Json::array()}}}) {
        if (!extension.is_null())
            builder.json["extensions"][kExtension] = extension;
        const Scene scene = builder.import();
        EXPECT_TRUE(scene.punctualLights.empty());
        EXPECT_EQ(scene.ignoredExtensions, std::vector<std::string>());
        EXPECT_EQ(warningsWith(scene, kExtension), 0);
    }
}

// Expects that error of a sound file with one value changed.
void expectErrorAfter(const char* pointer, const Json& value, const std::string& text) {
    GltfBuilder builder = fileWith({{"type", "spot"}, {"spot", Json::object()}});
    builder.json[Json::json_pointer(pointer)] = value;
    const std::string error = importError(builder);
    EXPECT_NE(error.find(text), std::string::npos) << "got: \"" << error << "\", wanted: " << text;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

TEST(BrokenGltfLight, ReferencesOutOfRangeNameThePropertyAndTheFigures) {
    const char* node = "/nodes/1/extensions/KHR_lights_punctual";
    const std::string name = "nodes[1].extensions.KHR_lights_punctual";
    expectErrorAfter(node, {{"light", 1}}, name + ".light is 1, but the file has 1 lights");
    expectErrorAfter(node, {{"light", -1}}, name + ".light is -1 instead of an integer");
    expectErrorAfter(node, Json::object(), name + " has no \"light\"");
    for (const Json& extensions : {Json::object(), Json{{kExtension, Json::object()}},
                                   Json{{kExtension, {{"lights", Json::array()}}}}})
        expectErrorAfter("/extensions", extensions, name + ".light is 0, but the file has 0 lights");
}

TEST(BrokenGltfLight, WrongTypesNameTheProperty) {
    const std::string root = "extensions.KHR_lights_punctual";
    expectErrorAfter("/extensions/KHR_lights_punctual", {1}, root + " is not an object");
    expectErrorAfter("/extensions/KHR_lights_punctual/lights", Json::object(),
                     root + ".lights is not an array");
    expectErrorAfter("/extensions/KHR_lights_punctual/lights/0", 3, root + ".lights[0] is not an object");
    expectErrorAfter("/nodes/1/extensions/KHR_lights_punctual", 0,
                     "nodes[1].extensions.KHR_lights_punctual is not an object");
    const std::string light = root + ".lights[0]";
    const std::string at = "/extensions/KHR_lights_punctual/lights/0";
    expectErrorAfter(at.c_str(), Json::object(), light + " has no \"type\"");
    expectErrorAfter((at + "/type").c_str(), 3, light + ".type is not a string");
    expectErrorAfter((at + "/name").c_str(), 3, light + ".name is not a string");
    expectErrorAfter((at + "/color").c_str(), "#ff3366", light + ".color is not an array");
    expectErrorAfter((at + "/color").c_str(), {1, 1, 1, 1}, light + ".color has 4 elements instead of 3");
    expectErrorAfter((at + "/intensity").c_str(), "BRIGHT", light + ".intensity is not a number");
    expectErrorAfter((at + "/range").c_str(), "far", light + ".range is not a number");
    expectErrorAfter((at + "/spot").c_str(), 45.0, light + ".spot is not an object");
    expectErrorAfter((at + "/spot/innerConeAngle").c_str(), false,
                     light + ".spot.innerConeAngle is not a number");
    expectErrorAfter((at + "/spot/outerConeAngle").c_str(), "1",
                     light + ".spot.outerConeAngle is not a number");
}

TEST(BrokenGltfLight, SpotWithoutAConeNamesTheLight) {
    expectErrorAfter("/extensions/KHR_lights_punctual/lights/0", {{"type", "spot"}, {"name", "two\nlines"}},
                     "light 0 \"two lines\" is a spot light without \"spot\"");
}

} // namespace
} // namespace lavalight::test
