// Tests of damaged and hostile files: one line each, with the file's name, and never a crash.
#include <gtest/gtest.h>

#include "unit/gltf/errors.h"

namespace lavalight::test {
namespace {

// Expects an error of the good file with the value at `pointer` changed.
void expectErrorAfter(const char* pointer, const Json& value, const std::string& text) {
    GltfBuilder builder = goodFile();
    builder.json[Json::json_pointer(pointer)] = value;
    expectError(builder, text);
}

TEST(BrokenGltf, EveryTruncationOfAGlbIsAnErrorAndTheWholeIsNot) {
    const std::string whole = goodFile().glb();
    EXPECT_EQ(importError(whole), "");
    for (size_t length = 0; length < whole.size(); ++length)
        expectError(importError(whole.substr(0, length)), "test.glb", "");
}

TEST(BrokenGltf, EveryFlippedByteOfAGlbLoadsOrIsOneLine) {
    const std::string whole = goodFile().glb();
    for (size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x15);
        EXPECT_EQ(importError(damaged).find('\n'), std::string::npos) << i;
    }
}

TEST(BrokenGltf, ChunkThatAnnouncesMoreThanTheFileHoldsIsAnError) {
    const std::string whole = goodFile().glb();
    const size_t binaryLength = whole.find("BIN") - 4; // where the BIN chunk keeps its length
    for (const size_t excess : {size_t{4}, size_t{0xFFFFFFFF} - 44}) {
        std::string damaged = whole;
        damaged.replace(binaryLength, 4, fourBytes(44 + excess)); // it has 44 bytes
        expectError(importError(damaged), "test.glb", "a chunk announces");
    }
}

TEST(BrokenGltf, FilesThatAreNoGltfSaySo) {
    expectError(importError("Dear reader, this is a letter."), "test.glb", "neither a .glb nor the JSON");
    expectError(importError(""), "test.glb", "empty");
    expectError(importError("{\"asset\": "), "test.glb", "JSON is damaged");
    expectError(importError("[]"), "test.glb", "neither");
    expectError(importError("{}"), "test.glb", "asset");
}

TEST(BrokenGltf, OtherVersionsAreRefused) {
    expectErrorAfter("/asset/version", "1.0", "glTF 1.0");
    expectErrorAfter("/asset/minVersion", "2.1", "glTF 2.1");
    GltfBuilder later = goodFile();
    later.json["asset"]["version"] = "2.1";
    EXPECT_EQ(importError(later), "");
}

TEST(BrokenGltf, NestingBeyondReasonIsAnErrorInsteadOfAStackOverflow) {
    std::string deep = R"({"asset":{"version":"2.0"},"extras":)";
    deep += std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}";
    expectError(importError(deep), "test.glb", "nested deeper");
}

TEST(BrokenGltf, ReferencesOutOfRangeNameThePropertyAndTheFigures) {
    expectErrorAfter("/nodes/0/mesh", 7, "nodes[0].mesh is 7, but the file has 1 meshes");
    expectErrorAfter("/nodes/0/children", {5}, "nodes[0].children[0] is 5");
    expectErrorAfter("/scene", 3, "scene is 3, but the file has 0 scenes");
    expectErrorAfter("/meshes/0/primitives/0/attributes/POSITION", 9, "POSITION is 9");
    expectErrorAfter("/meshes/0/primitives/0/indices", 9, "indices is 9");
    expectErrorAfter("/meshes/0/primitives/0/material", 99, "material is 99");
    expectErrorAfter("/accessors/0/bufferView", 9, "accessors[0].bufferView is 9");
    expectErrorAfter("/bufferViews/0/buffer", 7, "bufferViews[0].buffer is 7");
    expectErrorAfter("/bufferViews/0/buffer", uint64_t{1} << 32, "bufferViews[0].buffer is 4294967296");
}

TEST(BrokenGltf, DataOutOfRangeNamesTheObjectAndTheFigures) {
    expectErrorAfter("/accessors/0/count", 4, "accessor 0 needs 4 elements");
    expectErrorAfter("/accessors/0/count", uint64_t{1} << 62,
                     "accessor 0 needs 4611686018427387904 elements");
    expectErrorAfter("/accessors/0/byteOffset", 4, "from byte 4");
    expectErrorAfter("/accessors/0/byteOffset", UINT64_MAX, "from byte 18446744073709551615");
    expectErrorAfter("/bufferViews/0/byteOffset", UINT64_MAX, "buffer view 0 covers");
    expectErrorAfter("/bufferViews/0/byteLength", uint64_t{1} << 40,
                     "buffer view 0 covers 1099511627776 bytes");
    expectErrorAfter("/bufferViews/0/byteStride", 3, "byteStride is 3");
    expectErrorAfter("/bufferViews/0/byteStride", 4, "only 4 bytes apart");
    expectErrorAfter("/accessors/0/count", -1, "is -1 instead of an integer");
    expectErrorAfter("/accessors/0/componentType", 5124, "5124");
    expectErrorAfter("/accessors/0/type", "VEC5", "VEC5");
    expectErrorAfter("/accessors/0/type", "VEC2", "must be a VEC3");
    expectErrorAfter("/accessors/1/componentType", kShort, "holds no indices");
    expectErrorAfter("/meshes/0/primitives/0/mode", 9, "mode is 9");
    expectErrorAfter("/buffers", {{{"byteLength", uint64_t{1} << 62}}}, "byteLength is 4611686018427387904");
}

TEST(BrokenGltf, IndexBeyondTheVerticesIsAnError) {
    GltfBuilder builder = goodFile();
    const int indices = builder.addIndices<uint16_t>({0, 1, 3}, kUnsignedShort);
    builder.json["meshes"][0]["primitives"][0]["indices"] = indices;
    expectError(builder, "accessor 2 has the index 3 at 2, but there are 3 vertices");
}

TEST(BrokenGltf, AttributesOfDifferentCountsAreAnError) {
    GltfBuilder builder = goodFile();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = builder.addVec3({{0, 0, 1}});
    expectError(builder, "3 vertices but 1 elements of NORMAL");
}

TEST(BrokenGltf, SparseElementsOutOfRangeAreAnError) {
    GltfBuilder builder = goodFile();
    const Json sparse = {
        {"count", 1},
        {"indices", {{"bufferView", builder.addView<uint8_t>({3})}, {"componentType", 5121}}},
        {"values", {{"bufferView", builder.addView<glm::vec3>({{1, 1, 1}})}}}};
    builder.json["accessors"][0]["sparse"] = sparse;
    expectError(builder, "accessor 0 replaces element 3 of 3");
    builder.json["accessors"][0]["sparse"]["count"] = 2;
    expectError(builder, "accessor 0 (sparse indices) needs 2 elements");
    builder.json["accessors"][0]["sparse"]["count"] = 4;
    expectError(builder, "accessor 0 replaces 4 of its 3 elements");
}

TEST(BrokenGltf, WrongTypesNameTheProperty) {
    expectErrorAfter("/nodes", Json::object(), "nodes is not an array");
    expectErrorAfter("/nodes/0", "x", "nodes[0] is not an object");
    expectErrorAfter("/nodes/0/mesh", "0", "nodes[0].mesh is not an integer");
    expectErrorAfter("/nodes/0/mesh", nullptr, "nodes[0].mesh is not an integer");
    expectErrorAfter("/nodes/0/mesh", 0.5, "nodes[0].mesh is 0.5 instead of an integer");
    expectErrorAfter("/nodes/0/matrix", {1, 2}, "nodes[0].matrix has 2 elements instead of 16");
    expectErrorAfter("/nodes/0/scale", {1, 2, "3"}, "nodes[0].scale[2] is not a number");
    expectErrorAfter("/nodes/0/name", {1}, "nodes[0].name is not a string");
    expectErrorAfter("/nodes/0/extensions", {1}, "nodes[0].extensions is not an object");
    expectErrorAfter("/meshes/0/extensions", {1}, "\"extensions\" is not an object");
    expectErrorAfter("/meshes/0/primitives/0/attributes", 3, "attributes is not an object");
}

TEST(BrokenGltf, IntegersWrittenAsFloatingPointAreIntegers) {
    GltfBuilder builder = goodFile();
    builder.json["nodes"][0]["mesh"] = 0.0;
    builder.json["accessors"][0]["count"] = 3.0;
    EXPECT_EQ(builder.import().triangleCount(), 1u);
}

TEST(BrokenGltf, MoreTrianglesThanCanBeHeldAreRefusedBeforeTheyAreMade) {
    GltfBuilder builder = goodFile();
    builder.json["accessors"][0] = {{"componentType", kFloat}, {"count", 16'000'000}, {"type", "VEC3"}};
    builder.json["meshes"][0]["primitives"][0].erase("indices");
    for (int i = 0; i < 9; ++i)
        builder.addNode({{"mesh", 0}});
    expectError(builder, "triangles, at most");
    builder.json["accessors"][0]["count"] = 2'000'000'000;
    expectError(builder, "accessor 0 asks for 2000000000 elements without data");
}

TEST(BrokenGltf, CamerasNeedTheProjectionOfTheirType) {
    expectErrorAfter("/cameras", {{{"type", "fisheye"}, {"name", "eye"}}},
                     "camera 0 \"eye\" has the type \"fisheye\" instead of perspective or orthographic");
    expectErrorAfter("/cameras", {{{"type", "perspective"}}}, "camera 0 has no \"perspective\"");
    expectErrorAfter("/cameras", {{{"type", "orthographic"}, {"orthographic", 3}}},
                     "cameras[0].orthographic is not an object");
}

TEST(BrokenGltf, SkinsNeedJoints) {
    expectErrorAfter("/skins", Json::array({Json::object()}), "skins[0] has no \"joints\"");
}

TEST(BrokenGltf, ChannelsWithoutANodeMoveNothing) {
    GltfBuilder builder = goodFile();
    const int times = builder.addAccessor({{"componentType", kFloat}, {"count", 1}, {"type", "SCALAR"}});
    builder.json["animations"] = {{{"samplers", {{{"input", times}, {"output", 0}}}},
                                   {"channels", {{{"sampler", 5}, {"target", {{"path", "scale"}}}}}}}};
    EXPECT_EQ(importGltf("test.glb", builder.glb(), {.seconds = 0.0}).triangleCount(), 1u);
    builder.json["animations"][0]["channels"][0]["target"]["node"] = 0;
    EXPECT_THROW((void)importGltf("test.glb", builder.glb(), {.seconds = 0.0}), Error);
}

TEST(BrokenGltf, NamesWithLineBreaksStayOnOneLine) {
    GltfBuilder builder = goodFile();
    builder.json["accessors"][0]["name"] = "two\nlines";
    builder.json["accessors"][0]["count"] = 4;
    expectError(builder, "\"two lines\"");
}

} // namespace
} // namespace lavalight::test
