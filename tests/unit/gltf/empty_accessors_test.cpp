// Tests of accessors, buffers and meshes of nothing: the rest of the scene is shown.
#include <functional>

#include <gtest/gtest.h>

#include "unit/gltf/errors.h"

namespace lavalight::test {
namespace {

int addEmpty(GltfBuilder& builder, const char* type, int componentType = kFloat) {
    return builder.addAccessor({{"componentType", componentType}, {"count", 0}, {"type", type}});
}

Json& primitiveOf(GltfBuilder& builder) {
    return builder.json["meshes"][0]["primitives"][0];
}

TEST(EmptyGltf, FileOfTheFieldShowsItsOtherMesh) {
    const Scene scene = importGltf(std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/count0.gltf");
    EXPECT_EQ(scene.triangleCount(), 2u);
    EXPECT_EQ(warningsWith(scene, "accessors without elements were taken as if they were not there: "
                                  "accessor 4"),
              1);
    EXPECT_EQ(warningsWith(scene, "a primitive without positions shows nothing: mesh 1"), 1);
}

// One file for each, with the triangle of goodFile() beside what is empty.
TEST(EmptyGltf, RestOfTheSceneIsShownWhateverIsEmpty) {
    using Change = std::function<void(GltfBuilder&)>;
    const auto withMesh = [](Json primitives) -> Change {
        return [primitives = std::move(primitives)](GltfBuilder& builder) {
            builder.json["meshes"].push_back({{"primitives", primitives}});
            builder.addNode({{"mesh", 1}});
        };
    };
    const auto withEmpty = [](const char* type, Json primitive) -> Change {
        return [type, primitive = std::move(primitive)](GltfBuilder& builder) {
            (void)addEmpty(builder, type); // accessor 2
            builder.json["meshes"].push_back({{"primitives", Json::array({primitive})}});
            builder.addNode({{"mesh", 1}});
        };
    };
    const std::vector<std::pair<Change, const char*>> changes = {
        {withMesh(Json::array()), "a mesh without primitives shows nothing: mesh 1"},
        {[](GltfBuilder& builder) {
             builder.json["meshes"].push_back(Json::object());
             builder.addNode({{"mesh", 1}});
         },
         "a mesh without primitives shows nothing: mesh 1"},
        {withMesh(Json::array({Json::object()})), "a primitive without positions shows nothing: mesh 1"},
        {withMesh(Json::array({{{"attributes", Json::object()}, {"indices", 1}}})),
         "a primitive without positions shows nothing: mesh 1"},
        {withMesh(Json::array({{{"attributes", {{"NORMAL", 0}}}}})),
         "a primitive without positions shows nothing"},
        {withEmpty("VEC3", {{"attributes", {{"POSITION", 2}}}, {"indices", 1}}),
         "a primitive without positions shows nothing: mesh 1"},
        {withEmpty("SCALAR", {{"attributes", {{"POSITION", 0}}}, {"indices", 2}}),
         "a primitive without triangles shows nothing: mesh 1"},
        {withEmpty("VEC3", {{"attributes", {{"POSITION", 2}}}, {"mode", 1}}), "points and lines"},
        {[](GltfBuilder& builder) {
             builder.json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 0}});
             builder.addAccessor({{"bufferView", builder.json["bufferViews"].size() - 1},
                                  {"byteOffset", 1000},
                                  {"componentType", kFloat},
                                  {"count", 0},
                                  {"type", "VEC3"}});
         },
         "accessors without elements"},
        {[](GltfBuilder& builder) {
             (void)addEmpty(builder, "VEC3");
             builder.json["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", 2}}};
         },
         "accessors without elements"},
        {[](GltfBuilder& builder) {
             builder.addNode({{"mesh", 0}, {"scale", {0, 0, 0}}});
         },
         "without area"}};
    for (const auto& [change, warning] : changes) {
        GltfBuilder builder = goodFile();
        change(builder);
        EXPECT_EQ(importError(builder), "") << warning;
        const Scene scene = builder.import();
        EXPECT_EQ(scene.triangleCount(), 1u) << warning;
        EXPECT_EQ(warningsWith(scene, warning), 1) << warning;
    }
}

TEST(EmptyGltf, EmptyAttributesAndTargetsAreAsIfTheyWereNotThere) {
    GltfBuilder builder = goodFile();
    const int none3 = addEmpty(builder, "VEC3");
    const int none4 = addEmpty(builder, "VEC4", kUnsignedByte);
    Json& attributes = primitiveOf(builder)["attributes"];
    attributes["NORMAL"] = none3;
    for (const char* name : {"COLOR_0", "TANGENT", "JOINTS_0", "WEIGHTS_0"})
        attributes[name] = none4;
    attributes["TEXCOORD_0"] = addEmpty(builder, "VEC2");
    primitiveOf(builder)["targets"] = {{{"POSITION", none3}}, {{"NORMAL", none3}}};
    builder.json["nodes"][0]["weights"] = {1, 1};
    const Scene scene = builder.import();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    EXPECT_TRUE(scene.meshes[0].colors.empty());
    EXPECT_TRUE(scene.meshes[0].uvs.empty());
    EXPECT_EQ(scene.meshes[0].positions.at(1), glm::vec3(1, 0, 0));
    EXPECT_EQ(warningsWith(scene, "accessor 2, accessor 3, accessor 4"), 1);
}

TEST(EmptyGltf, EmptyAnimationsMatricesInstancesAndSparseElementsChangeNothing) {
    GltfBuilder builder = goodFile();
    const int times = addEmpty(builder, "SCALAR");
    const int values = addEmpty(builder, "VEC3");
    builder.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", values}}, {{"input", 0}, {"output", values}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
           {{"sampler", 1}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}};
    builder.json["accessors"][0]["sparse"] = {
        {"count", 0},
        {"indices", {{"bufferView", 0}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", 0}}}};
    builder.addNode({{"mesh", 0},
                     {"extensions",
                      {{"EXT_mesh_gpu_instancing",
                        {{"attributes", {{"TRANSLATION", 0}, {"SCALE", values}}}}}}}}); // no instance
    const Scene scene = importGltf("test.glb", builder.glb(), {.seconds = 0.5});
    EXPECT_EQ(scene.triangleCount(), 1u);
    EXPECT_EQ(scene.meshes[0].positions.at(1), glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.animations.at(0).seconds, 0.0f);
}

TEST(EmptyGltf, BuffersOfNothingAreNoError) {
    GltfBuilder builder = goodFile();
    builder.json["buffers"] = {{{"byteLength", builder.bytes.size()}},
                               {{"byteLength", 0}},
                               {{"byteLength", 0}, {"uri", ""}},
                               {{"byteLength", 0}, {"uri", "data:;base64,"}}};
    EXPECT_EQ(importError(builder), "");
    EXPECT_EQ(builder.import().triangleCount(), 1u);
}

} // namespace
} // namespace lavalight::test
