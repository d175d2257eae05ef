// Tests of KHR_animation_pointer: what can be animated, at which time, and what is left as it is.
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// A triangle with a material, a camera and a lamp, whose member `pointer` goes from 0 s to 2 s through
// `keys`.
GltfBuilder animated(const std::string& pointer, const std::vector<float>& keys, const char* type,
                     const std::string& interpolation = "LINEAR") {
    GltfBuilder builder;
    builder.addNode({{"mesh", builder.addTriangle()}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0.5}}},
                                  {"extensions",
                                   {{"KHR_materials_sheen", {{"sheenRoughnessFactor", 0.1}}},
                                    {"KHR_materials_volume", Json::object()}}}}};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    builder.addNode({{"camera", 0}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 1.0}}};
    builder.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const int input = builder.addAccessor({{"bufferView", builder.addView(std::vector<float>{0.0f, 2.0f})},
                                           {"componentType", kFloat},
                                           {"count", 2},
                                           {"type", "SCALAR"}});
    const size_t components = std::string(type) == "SCALAR" ? 1 : static_cast<size_t>(type[3] - '0');
    const int output = builder.addAccessor({{"bufferView", builder.addView(keys)},
                                            {"componentType", kFloat},
                                            {"count", keys.size() / components},
                                            {"type", type}});
    const Json target = {{"path", "pointer"},
                         {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    builder.json["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", target}}}}}};
    return builder;
}

Scene at(const GltfBuilder& builder, double seconds) {
    return importGltf("test.glb", builder.glb(), {.seconds = seconds});
}

Scene halfWay(const std::string& pointer, const std::vector<float>& keys, const char* type) {
    return at(animated(pointer, keys, type), 1.0);
}

TEST(GltfAnimationPointer, FactorsOfMaterialsAreMixedBetweenKeys) {
    const Scene scene =
        halfWay("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 0, 0, 1, 0, 1, 0, 1}, "VEC4");
    EXPECT_EQ(scene.materials.at(0).baseColor, glm::vec3(0.5f, 0.5f, 0.0f));
    EXPECT_FLOAT_EQ(halfWay("/materials/0/pbrMetallicRoughness/metallicFactor", {0, 0.5f}, "SCALAR")
                        .materials.at(0)
                        .metallic,
                    0.25f);
    EXPECT_TRUE(scene.ignoredExtensions.empty());
    EXPECT_TRUE(scene.warnings.empty() || scene.warnings.front().find("animated") == std::string::npos);
}

TEST(GltfAnimationPointer, MembersOfExtensionsAreAnimated) {
    EXPECT_FLOAT_EQ(
        halfWay("/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor", {0.2f, 0.4f}, "SCALAR")
            .materials.at(0)
            .sheenRoughness,
        0.3f);
    EXPECT_FLOAT_EQ(
        halfWay("/materials/0/extensions/KHR_materials_volume/attenuationDistance", {1, 3}, "SCALAR")
            .materials.at(0)
            .attenuationDistance,
        2.0f);
}

TEST(GltfAnimationPointer, CamerasAndLightsAreAnimated) {
    EXPECT_FLOAT_EQ(halfWay("/cameras/0/perspective/yfov", {0.2f, 0.6f}, "SCALAR").cameras.at(0).verticalFov,
                    0.4f);
    EXPECT_EQ(halfWay("/extensions/KHR_lights_punctual/lights/0/color", {1, 0, 0, 0, 0, 1}, "VEC3")
                  .punctualLights.at(0)
                  .intensity,
              glm::vec3(0.5f, 0.0f, 0.5f));
}

TEST(GltfAnimationPointer, NodesMoveTurnAndVanish) {
    const Scene moved = halfWay("/nodes/0/translation", {0, 0, 0, 4, 2, 0}, "VEC3");
    EXPECT_EQ(moved.meshes.at(0).positions.at(0), glm::vec3(2, 1, 0));
    const float half = std::sqrt(0.5f); // a quarter turn about z, a quarter of which is 22.5 degrees
    const Scene turned = at(animated("/nodes/0/rotation", {0, 0, 0, 1, 0, 0, half, half}, "VEC4"), 0.5);
    EXPECT_NEAR(turned.meshes.at(0).positions.at(1).x, std::cos(0.39269908f), 1e-6f);
    EXPECT_NEAR(turned.meshes.at(0).positions.at(1).y, std::sin(0.39269908f), 1e-6f);

    GltfBuilder builder =
        animated("/nodes/0/extensions/KHR_node_visibility/visible", {1, 0}, "SCALAR", "STEP");
    builder.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = true;
    EXPECT_EQ(at(builder, 1.9).meshes.size(), 1u);
    EXPECT_TRUE(at(builder, 2.0).meshes.empty());
}

TEST(GltfAnimationPointer, TextureTransformsMove) {
    GltfBuilder builder =
        animated("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset",
                 {0, 0, 1, 2}, "VEC2");
    builder.json["images"] = {
        {{"uri",
          "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4z8DA0PAfAAgA"
          "An+cRUBOAAAAAElFTkSuQmCC"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
        {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {1, 1}}}}}}};
    const Scene scene = at(builder, 1.0);
    const std::optional<Texture>& texture = scene.materials.at(0).texture(TextureSlot::baseColor);
    ASSERT_TRUE(texture.has_value());
    EXPECT_FLOAT_EQ(texture->uRow.z, 0.5f);
    EXPECT_FLOAT_EQ(texture->vRow.z, 1.0f);
}

TEST(GltfAnimationPointer, WithoutATimeTheFileIsAsItIs) {
    const GltfBuilder builder =
        animated("/materials/0/pbrMetallicRoughness/metallicFactor", {0, 1}, "SCALAR");
    EXPECT_FLOAT_EQ(builder.import().materials.at(0).metallic, 0.5f);
}

TEST(GltfAnimationPointer, WhatIsNotReadOrNotThereIsNamedByItsPointer) {
    for (const char* pointer :
         {"/materials/0/alphaMode", "/materials/0/doubleSided", "/materials/7/alphaCutoff", "/nodes/0/matrix",
          "/materials/0/extensions/KHR_materials_ior/ior", "/materials/0/extras/shine", "/accessors/0/count",
          "/cameras/0/orthographic/xmag", "/nodes/0/weights/3", "/materials/-/alphaCutoff",
          "/materials/00/alphaCutoff", "/materials", "/", "", "materials/0/alphaCutoff", "/materials/0/~2"}) {
        const Scene scene = halfWay(pointer, {0.25f, 0.75f}, "SCALAR");
        const bool isNamed = warningsWith(scene, std::string("were left as they are: ") + pointer) == 1;
        EXPECT_TRUE(isNamed || std::string(pointer).empty()) << pointer;
    }
}

TEST(GltfAnimationPointer, ArraysAndTheirElementsMayBothBeAnimated) {
    GltfBuilder builder = animated("/nodes/0/weights", {0, 0, 2, 4}, "SCALAR");
    const int displaced = builder.addVec3({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
    const int lifted = builder.addVec3({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", displaced}},
                                                             {{"POSITION", lifted}}};
    builder.json["nodes"][0]["weights"] = {0.0, 0.0};
    EXPECT_EQ(at(builder, 1.0).meshes.at(0).positions.at(0), glm::vec3(0, 2, 1));
    GltfBuilder single = builder;
    Json& channel = single.json["animations"][0]["channels"][0];
    Json second = channel;
    second["target"]["extensions"]["KHR_animation_pointer"]["pointer"] = "/nodes/0/weights/1";
    second["sampler"] = 1;
    const int output = single.addAccessor({{"bufferView", single.addView(std::vector<float>{6.0f, 8.0f})},
                                           {"componentType", kFloat},
                                           {"count", 2},
                                           {"type", "SCALAR"}});
    Json sampler = single.json["animations"][0]["samplers"][0];
    sampler["output"] = output;
    single.json["animations"][0]["samplers"].push_back(sampler);
    single.json["animations"][0]["channels"].push_back(second);
    EXPECT_EQ(at(single, 1.0).meshes.at(0).positions.at(0), glm::vec3(0, 7, 1));
}

TEST(GltfAnimationPointer, ElementsThatAnArrayDoesNotHaveAreNotAdded) {
    for (const char* pointer : {"/meshes/0/weights/2", "/meshes/0/weights/01"}) {
        GltfBuilder builder = animated(pointer, {1, 1}, "SCALAR");
        builder.json["meshes"][0]["weights"] = {0.0, 0.0};
        EXPECT_EQ(warningsWith(at(builder, 1.0), std::string("were left as they are: ") + pointer), 1);
    }
}

TEST(GltfAnimationPointer, KeysOfAnotherTypeOrWithoutEndAreRefused) {
    EXPECT_THROW(
        (void)halfWay("/materials/0/pbrMetallicRoughness/metallicFactor", {0, 0, 0, 1, 1, 1}, "VEC3"), Error);
    EXPECT_THROW(
        (void)halfWay("/materials/0/pbrMetallicRoughness/metallicFactor", {INFINITY, INFINITY}, "SCALAR"),
        Error);
}

} // namespace
} // namespace lavalight::test
