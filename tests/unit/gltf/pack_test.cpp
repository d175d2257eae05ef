// Tests of packed scenes: one .glb in place of a file and what it refers to, with nothing changed.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "base/base64.h"
#include "base/file.h"
#include "gltf/pack.h"
#include "image/png.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

void expectSame(const Scene& packed, const Scene& scene, const std::string& name) {
    ASSERT_EQ(packed.meshes.size(), scene.meshes.size()) << name;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        EXPECT_EQ(packed.meshes[i].positions, scene.meshes[i].positions) << name << ", mesh " << i;
        EXPECT_EQ(packed.meshes[i].triangles, scene.meshes[i].triangles) << name << ", mesh " << i;
        EXPECT_EQ(packed.meshes[i].normals, scene.meshes[i].normals) << name << ", mesh " << i;
    }
    ASSERT_EQ(packed.pictures.size(), scene.pictures.size()) << name;
    for (size_t i = 0; i < scene.pictures.size(); ++i)
        EXPECT_EQ(packed.pictures[i].bytes, scene.pictures[i].bytes) << name << ", picture " << i;
    EXPECT_EQ(packed.materials.size(), scene.materials.size()) << name;
    EXPECT_EQ(packed.cameras.size(), scene.cameras.size()) << name;
    EXPECT_EQ(packed.punctualLights.size(), scene.punctualLights.size()) << name;
}

Json jsonOf(const std::string& glb) {
    const size_t length = static_cast<unsigned char>(glb[12]) | static_cast<unsigned char>(glb[13]) << 8u |
                          static_cast<unsigned char>(glb[14]) << 16u;
    return Json::parse(glb.substr(20, length));
}

std::string pngOf(uint32_t width, uint32_t height) {
    return encodePng(width, height, std::vector<uint32_t>(size_t{width} * height, 0xff2040c0u), {});
}

// A textured square, whose triangles are in one buffer and whose vertices, compressed, in another; a third is
// only declared.
struct SquareFile {
    TemporaryFolder folder;
    std::filesystem::path gltf = folder / "square.gltf";
    Json json;

    SquareFile() {
        const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        const std::vector<uint32_t> triangles = {0, 1, 2, 0, 2, 3};
        std::string stream(meshopt_encodeVertexBufferBound(4, sizeof(glm::vec3)), '\0');
        stream.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(stream.data()),
                                                 stream.size(), corners.data(), 4, sizeof(glm::vec3)));
        const std::string indices(reinterpret_cast<const char*>(triangles.data()), 24);
        const std::string uvs(32, '\0');
        writeFileAtomically(folder / "tri angles.bin", "??" + indices + uvs);
        writeFileAtomically(folder / "wood.png", pngOf(2, 2));
        json = Json::parse(R"({
            "asset": {"version": "2.0"}, "extensionsUsed": ["EXT_meshopt_compression"],
            "extensionsRequired": ["EXT_meshopt_compression"],
            "buffers": [{"byteLength": 58, "uri": "tri%20angles.bin"}, {"byteLength": 48}, {}],
            "bufferViews": [
                {"buffer": 0, "byteOffset": 2, "byteLength": 24},
                {"buffer": 0, "byteOffset": 26, "byteLength": 32},
                {"buffer": 1, "byteLength": 48, "byteStride": 12, "extensions": {"EXT_meshopt_compression": {
                    "buffer": 2, "mode": "ATTRIBUTES", "count": 4, "byteStride": 12}}}],
            "accessors": [
                {"bufferView": 0, "componentType": 5125, "count": 6, "type": "SCALAR"},
                {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3"}],
            "images": [{"uri": "wood.png"}, {}, {"uri": "missing.png"}],
            "textures": [{"source": 0}, {"source": 1}, {"source": 2}],
            "materials": [
                {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}},
                {"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}],
            "meshes": [{"primitives": [
                {"attributes": {"POSITION": 2, "TEXCOORD_0": 1}, "indices": 0, "material": 0},
                {"attributes": {"POSITION": 2, "TEXCOORD_0": 1}, "indices": 0, "material": 1},
                {"attributes": {"POSITION": 2, "TEXCOORD_0": 1}, "indices": 0, "material": 2}]}],
            "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]})");
        json["bufferViews"][2]["extensions"]["EXT_meshopt_compression"]["byteLength"] = stream.size();
        json["buffers"][2] = {{"byteLength", stream.size()},
                              {"uri", "data:application/octet-stream;base64," + encodeBase64(stream)}};
        json["images"][1] = {{"uri", "data:image/png;base64," + encodeBase64(pngOf(3, 1))}};
        save();
    }

    void save() const { writeFileAtomically(gltf, json.dump()); }
};

TEST(PackTest, OneFileHoldsWhatTheSceneRefersTo) {
    const SquareFile square;
    const PackedScene packed = packGltf(square.gltf);
    const Scene scene = importGltf(square.gltf);
    ASSERT_EQ(scene.meshes.front().positions[2], glm::vec3(1, 1, 0));
    ASSERT_EQ(scene.pictures.size(), 2u);
    expectSame(importGltf("packed", packed.glb), scene, "square");
    const Json json = jsonOf(packed.glb);
    EXPECT_EQ(json["images"][0]["mimeType"], "image/png");
    for (const Json& buffer : json["buffers"])
        EXPECT_FALSE(buffer.contains("uri"));
}

TEST(PackTest, PicturesThatCannotBeHadAreNamed) {
    const SquareFile square;
    const PackedScene packed = packGltf(square.gltf);
    ASSERT_EQ(packed.warnings.size(), 1u);
    EXPECT_NE(packed.warnings.front().find("missing.png"), std::string::npos);
    EXPECT_EQ(warningsWith(importGltf("packed", packed.glb), "image 2"), 1);
}

TEST(PackTest, AFileThatRefersToNothingStaysAsItIs) {
    GltfBuilder builder;
    builder.addTriangle();
    builder.addNode({{"mesh", 0}});
    builder.json["buffers"] = {{{"byteLength", builder.bytes.size()}}};
    builder.bytes +=
        std::string(8, 'x'); // behind the buffer, so that it would be lost if the file were packed anew
    const TemporaryFolder folder;
    writeFileAtomically(folder / "triangle.glb", builder.glb());
    EXPECT_EQ(packGltf(folder / "triangle.glb").glb, builder.glb());
    const SquareFile square;
    const std::string once = packGltf(square.gltf).glb;
    Json json = jsonOf(once);
    EXPECT_FALSE(json["images"][2].contains("uri")); // a file of that name beside the new scene is another
    writeFileAtomically(folder / "packed.glb", once);
    expectSame(importGltf("twice", packGltf(folder / "packed.glb").glb), importGltf(square.gltf), "twice");
}

TEST(PackTest, FilesOutsideTheFolderArePackedOnlyWhenAllowed) {
    SquareFile square;
    std::filesystem::create_directory(square.folder / "inner");
    const std::filesystem::path inner = square.folder / "inner/square.gltf";
    square.json["buffers"][0]["uri"] = "../tri angles.bin";
    square.json["images"][0]["uri"] = "../wood.png";
    writeFileAtomically(inner, square.json.dump());
    EXPECT_THROW(static_cast<void>(packGltf(inner)), Error);
    ImportOptions options;
    options.allowsExternal = true;
    expectSame(importGltf("packed", packGltf(inner, true).glb), importGltf(inner, options), "outside");
}

TEST(PackTest, AMissingBufferFailsWithItsName) {
    SquareFile square;
    square.json["buffers"][0]["uri"] = "gone.bin";
    square.save();
    try {
        static_cast<void>(packGltf(square.gltf));
        FAIL() << "a scene without its buffer was packed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("gone.bin"), std::string::npos) << error.what();
    }
}

TEST(PackTest, AFileOfNodesAloneCanBePacked) {
    const TemporaryFolder folder;
    writeFileAtomically(
        folder / "empty.gltf",
        std::string(R"({"asset": {"version": "2.0"}, "nodes": [{}], "scenes": [{"nodes": [0]}]})"));
    EXPECT_TRUE(importGltf("packed", packGltf(folder / "empty.gltf").glb).meshes.empty());
}

TEST(PackTest, SharedScenesImportTheSameOncePacked) {
    const char* folder = std::getenv("LAVALIGHT_ASSETS");
    if (folder == nullptr)
        GTEST_SKIP() << "LAVALIGHT_ASSETS is not set: the folder with glTF sample scenes";
    constexpr uintmax_t kLargest =
        300'000; // bytes of the .gltf and of the .bin beside it: pictures take long to decode
    size_t scenes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        std::filesystem::path binary = entry.path();
        binary.replace_extension(".bin");
        std::error_code none;
        if (entry.path().extension() != ".gltf" || entry.file_size() > kLargest ||
            (std::filesystem::exists(binary, none) && std::filesystem::file_size(binary) > kLargest))
            continue;
        try {
            expectSame(importGltf("packed", packGltf(entry.path()).glb), importGltf(entry.path()),
                       entry.path().string());
            ++scenes;
        } catch (const Error& error) { // broken on purpose: importing says so, too
            EXPECT_THROW(static_cast<void>(importGltf(entry.path())), Error) << error.what();
        }
    }
    EXPECT_GE(scenes, 20u);
}

} // namespace
} // namespace lavalight::test
