// Tests of geometry compressed by meshoptimizer and by Draco: round trips through their encoders, damaged and
// unknown streams, and real files beside their uncompressed twins.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "support/memory_limit.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

const std::vector<glm::vec3> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<uint32_t> kCorners = {0, 1, 2, 0, 2, 3};

using Bytes = std::vector<unsigned char>;

// A view of `count` elements that are only there as a stream of the extension; returns its number.
int addCompressed(GltfBuilder& builder, const Bytes& stream, const std::string& mode, size_t count,
                  size_t stride, const std::string& filter = "NONE") {
    const int raw = builder.addView(stream);
    const Json where = builder.json["bufferViews"][static_cast<size_t>(raw)];
    Json extension = {{"buffer", 0}, {"byteOffset", where["byteOffset"]}, {"byteLength", stream.size()}};
    extension.update({{"mode", mode}, {"count", count}, {"byteStride", stride}, {"filter", filter}});
    builder.json["bufferViews"].push_back({{"buffer", 1},
                                           {"byteLength", count * stride},
                                           {"extensions", {{"EXT_meshopt_compression", extension}}}});
    return raw + 1;
}

// The buffers: the BIN chunk, and one without data that compressed views stand on.
void declareBuffers(GltfBuilder& builder) {
    builder.json["buffers"] = {{{"byteLength", builder.bytes.size()}}, {{"byteLength", 1 << 20}}};
}

template <class T>
Bytes encodeVertices(const std::vector<T>& values) {
    Bytes stream(meshopt_encodeVertexBufferBound(values.size(), sizeof(T)));
    stream.resize(
        meshopt_encodeVertexBuffer(stream.data(), stream.size(), values.data(), values.size(), sizeof(T)));
    return stream;
}

Bytes encodeTriangles() {
    Bytes stream(meshopt_encodeIndexBufferBound(kCorners.size(), kSquare.size()));
    stream.resize(meshopt_encodeIndexBuffer(stream.data(), stream.size(), kCorners.data(), kCorners.size()));
    return stream;
}

struct Square {
    GltfBuilder builder;
    size_t positionsView = 0;
};

// The square, its positions and indices compressed.
Square compressedSquare() {
    Square square;
    GltfBuilder& builder = square.builder;
    const int positions = addCompressed(builder, encodeVertices(kSquare), "ATTRIBUTES", 4, 12);
    const int indices = addCompressed(builder, encodeTriangles(), "TRIANGLES", 6, 4);
    square.positionsView = static_cast<size_t>(positions);
    const int vertices = builder.addAccessor(
        {{"bufferView", positions}, {"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}});
    const int corners = builder.addAccessor(
        {{"bufferView", indices}, {"componentType", kUnsignedInt}, {"count", 6}, {"type", "SCALAR"}});
    builder.addNode(
        {{"mesh", builder.addMesh({{"attributes", {{"POSITION", vertices}}}, {"indices", corners}})}});
    declareBuffers(builder);
    return square;
}

Json& extensionOf(Square& square) {
    return square.builder.json["bufferViews"][square.positionsView]["extensions"]["EXT_meshopt_compression"];
}

TEST(GltfMeshopt, VerticesAndTrianglesComeBackAsTheyWent) {
    const Mesh mesh = compressedSquare().builder.import().meshes.at(0);
    EXPECT_EQ(mesh.positions, kSquare);
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(GltfMeshopt, IndexSequencesComeBackInTwoBytesEach) {
    GltfBuilder builder;
    Bytes stream(meshopt_encodeIndexSequenceBound(kCorners.size(), kSquare.size()));
    stream.resize(
        meshopt_encodeIndexSequence(stream.data(), stream.size(), kCorners.data(), kCorners.size()));
    const int indices = addCompressed(builder, stream, "INDICES", 6, 2);
    const int corners = builder.addAccessor(
        {{"bufferView", indices}, {"componentType", kUnsignedShort}, {"count", 6}, {"type", "SCALAR"}});
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", builder.addVec3(kSquare)}}},
                                               {"indices", corners}})}});
    declareBuffers(builder);
    EXPECT_EQ(builder.import().meshes.at(0).triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(GltfMeshopt, OctahedralFilterGivesUnitNormals) {
    GltfBuilder builder;
    const glm::vec4 tilted(glm::normalize(glm::vec3(1, 2, 2)), 0.0f);
    const std::vector<glm::vec4> normals(4, tilted);
    std::vector<std::array<int16_t, 4>> encoded(4);
    meshopt_encodeFilterOct(encoded.data(), 4, 8, 15, &normals[0].x);
    const int view = addCompressed(builder, encodeVertices(encoded), "ATTRIBUTES", 4, 8, "OCTAHEDRAL");
    builder.json["bufferViews"].back()["byteStride"] = 8;
    const int normal = builder.addAccessor({{"bufferView", view},
                                            {"componentType", kShort},
                                            {"normalized", true},
                                            {"count", 4},
                                            {"type", "VEC3"}});
    const int corners = builder.addIndices(kCorners, kUnsignedInt);
    builder.addNode({{"mesh", builder.addMesh({{"attributes",
                                                {{"POSITION", builder.addVec3(kSquare)}, {"NORMAL", normal}}},
                                               {"indices", corners}})}});
    declareBuffers(builder);
    const Mesh mesh = builder.import().meshes.at(0);
    EXPECT_NEAR(glm::length(mesh.normals.at(2) - glm::vec3(tilted)), 0.0f, 1e-3f);
}

TEST(GltfMeshopt, DamagedStreamsAndFiguresThatDoNotFitAreRefusedByTheViewsName) {
    Square damaged = compressedSquare();
    extensionOf(damaged)["byteLength"] = 20;
    EXPECT_NE(importError(damaged.builder).find("is damaged"), std::string::npos)
        << importError(damaged.builder);
    for (const Json& wrong :
         {Json{{"count", 5}}, Json{{"byteStride", 0}}, Json{{"byteStride", 3}},
          Json{{"filter", "OCTAHEDRAL"}}, Json{{"mode", "INDICES"}}, Json{{"byteOffset", 1 << 20}}}) {
        Square square = compressedSquare();
        extensionOf(square).update(wrong);
        const std::string error = importError(square.builder);
        EXPECT_NE(error.find("buffer view 1 (EXT_meshopt_compression)"), std::string::npos) << error;
    }
}

TEST(GltfMeshopt, ViewThatClaimsMoreThanItsStreamCanHoldIsRefusedBeforeItIsMade) {
    Square square = compressedSquare();
    extensionOf(square)["count"] = 1u << 30;
    square.builder.json["bufferViews"][square.positionsView]["byteLength"] = uint64_t{12} << 30;
    EXPECT_NE(importError(square.builder).find("does not fit"), std::string::npos);
}

TEST(GltfMeshopt, UnknownCodecsAreRefusedByNameUnlessTheDataIsThereToo) {
    Square square = compressedSquare();
    const size_t start = extensionOf(square)["byteOffset"];
    square.builder.bytes[start] = static_cast<char>(0xA7);
    EXPECT_NE(importError(square.builder).find("uses version 7 of the codec for ATTRIBUTES, which is not"),
              std::string::npos);
    Square filtered = compressedSquare();
    extensionOf(filtered)["filter"] = "SHINY";
    EXPECT_NE(importError(filtered.builder).find("uses the filter \"SHINY\""), std::string::npos);

    const int plain = filtered.builder.addView(kSquare);
    Json& view = filtered.builder.json["bufferViews"][filtered.positionsView];
    view["buffer"] = 0;
    view["byteOffset"] = filtered.builder.json["bufferViews"][static_cast<size_t>(plain)]["byteOffset"];
    declareBuffers(filtered.builder);
    EXPECT_EQ(filtered.builder.import().meshes.at(0).positions, kSquare);
}

#if MESHOPTIMIZER_VERSION >= 1000
TEST(GltfMeshopt, VerticesOfCodecVersionOneComeBackAsTheyWent) {
    GltfBuilder builder;
    Bytes stream(meshopt_encodeVertexBufferBound(kSquare.size(), sizeof(glm::vec3)));
    stream.resize(meshopt_encodeVertexBufferLevel(stream.data(), stream.size(), kSquare.data(),
                                                  kSquare.size(), sizeof(glm::vec3), 3, 1));
    ASSERT_EQ(stream.front(), 0xA1);
    const int view = addCompressed(builder, stream, "ATTRIBUTES", 4, 12);
    Json& extensions = builder.json["bufferViews"].back()["extensions"];
    extensions["KHR_meshopt_compression"] = extensions["EXT_meshopt_compression"];
    extensions.erase("EXT_meshopt_compression");
    const int positions = builder.addAccessor(
        {{"bufferView", view}, {"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}});
    const int corners = builder.addIndices(kCorners, kUnsignedInt);
    builder.addNode(
        {{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", corners}})}});
    declareBuffers(builder);
    EXPECT_EQ(builder.import().meshes.at(0).positions, kSquare);
}

TEST(GltfMeshopt, VersionOneMayExpandAThousandTimes) {
    GltfBuilder builder;
    const std::vector<uint32_t> white(30000, 0xFFFFFFFF);
    Bytes stream(meshopt_encodeVertexBufferBound(white.size(), 4));
    stream.resize(
        meshopt_encodeVertexBufferLevel(stream.data(), stream.size(), white.data(), white.size(), 4, 3, 1));
    ASSERT_LT(stream.size() * 64, white.size() * 4);
    const int view = addCompressed(builder, stream, "ATTRIBUTES", white.size(), 4);
    builder.json["bufferViews"].back()["byteStride"] = 4;
    const int color = builder.addAccessor({{"bufferView", view},
                                           {"componentType", kUnsignedByte},
                                           {"normalized", true},
                                           {"count", white.size()},
                                           {"type", "VEC4"}});
    const std::vector<glm::vec3> positions(white.size(), glm::vec3(1.0f));
    builder.addNode(
        {{"mesh", builder.addMesh(
                      {{"attributes", {{"POSITION", builder.addVec3(positions)}, {"COLOR_0", color}}}})}});
    declareBuffers(builder);
    EXPECT_EQ(importError(builder), "");
}

TEST(GltfMeshopt, ColorFilterGivesTheColorsBack) {
    GltfBuilder builder;
    const std::vector<glm::vec4> colors = {
        {1, 0, 0, 1}, {0, 1, 0, 1}, {0.2f, 0.4f, 0.8f, 1}, {1, 1, 1, 0.5f}};
    std::vector<std::array<uint16_t, 4>> encoded(4);
    meshopt_encodeFilterColor(encoded.data(), 4, 8, 16, &colors[0].x);
    const int view = addCompressed(builder, encodeVertices(encoded), "ATTRIBUTES", 4, 8, "COLOR");
    builder.json["bufferViews"].back()["byteStride"] = 8;
    const int color = builder.addAccessor({{"bufferView", view},
                                           {"componentType", kUnsignedShort},
                                           {"normalized", true},
                                           {"count", 4},
                                           {"type", "VEC4"}});
    const int corners = builder.addIndices(kCorners, kUnsignedInt);
    builder.addNode({{"mesh", builder.addMesh({{"attributes",
                                                {{"POSITION", builder.addVec3(kSquare)}, {"COLOR_0", color}}},
                                               {"indices", corners}})}});
    declareBuffers(builder);
    const Mesh mesh = builder.import().meshes.at(0);
    ASSERT_EQ(mesh.colors.size(), 4u);
    for (size_t i = 0; i < colors.size(); ++i)
        EXPECT_NEAR(glm::length(mesh.colors[i] - colors[i]), 0.0f, 2e-4f) << i;
}
#endif

// The square as Draco has it, its positions exact.
std::string dracoSquare() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (int face = 0; face < 2; ++face) {
        const auto corner = [&](size_t i) { return &kSquare[kCorners[3 * static_cast<size_t>(face) + i]].x; };
        builder.SetAttributeValuesForFace(positions, draco::FaceIndex(static_cast<uint32_t>(face)), corner(0),
                                          corner(1), corner(2));
    }
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
    return {buffer.data(), buffer.size()};
}

GltfBuilder dracoBuilder(const std::string& stream, int id = 0) {
    GltfBuilder builder;
    const int view = builder.addView(std::vector<char>(stream.begin(), stream.end()));
    const int positions = builder.addAccessor({{"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}});
    const int indices =
        builder.addAccessor({{"componentType", kUnsignedShort}, {"count", 6}, {"type", "SCALAR"}});
    builder.addNode(
        {{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}}},
                                   {"indices", indices},
                                   {"extensions",
                                    {{"KHR_draco_mesh_compression",
                                      {{"bufferView", view}, {"attributes", {{"POSITION", id}}}}}}}})}});
    return builder;
}

TEST(GltfDraco, SquareComesBackAsItWent) {
    const Mesh mesh = dracoBuilder(dracoSquare()).import().meshes.at(0);
    ASSERT_EQ(mesh.positions.size(), 4u);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (const glm::vec3& corner : kSquare)
        EXPECT_NE(std::find(mesh.positions.begin(), mesh.positions.end(), corner), mesh.positions.end());
    EXPECT_EQ(frontOf(mesh, 0), glm::vec3(0, 0, 1));
    EXPECT_EQ(frontOf(mesh, 1), glm::vec3(0, 0, 1));
}

TEST(GltfDraco, CutStreamsAndMissingAttributesAreRefusedByTheMeshsName) {
    const std::string stream = dracoSquare();
    for (size_t length = 1; length < stream.size(); length += 7) {
        const std::string error = importError(dracoBuilder(stream.substr(0, length)));
        EXPECT_NE(error.find("mesh 0 \"part\" (KHR_draco_mesh_compression)"), std::string::npos) << error;
    }
    EXPECT_NE(importError(dracoBuilder(stream, 5)).find("no attribute 5 of the type of POSITION"),
              std::string::npos);
}

TEST(GltfDraco, StreamThatClaimsMoreTrianglesThanItCanHoldIsRefusedBeforeTheyAreMade) {
    // Head, sequential coding: 2^28 - 1 triangles and as many points, as numbers of 7 bits a byte.
    const std::string head("DRACO\x02\x02\x01\x00\x00\x00", 11);
    const std::string many("\xFF\xFF\xFF\x7F", 4);
    const std::string error = importError(dracoBuilder(head + many + many + std::string(64, '\0')));
    EXPECT_NE(error.find("states 268435455 triangles in 83 bytes"), std::string::npos) << error;
}

// A grid whose positions, and attributes of 127 zeros a point, take next to no bytes.
std::string dracoGrid(uint32_t side, int attributes = 1) {
    draco::Mesh mesh;
    const uint32_t points = side * side;
    mesh.set_num_points(points);
    const auto add = [&](draco::GeometryAttribute::Type type, int8_t components, draco::DataType data,
                         int64_t stride) {
        draco::GeometryAttribute attribute;
        attribute.Init(type, nullptr, static_cast<uint8_t>(components), data, false, stride, 0);
        return mesh.attribute(mesh.AddAttribute(attribute, true, points));
    };
    draco::PointAttribute* positions = add(draco::GeometryAttribute::POSITION, 3, draco::DT_INT32, 12);
    for (int i = 0; i < attributes; ++i)
        std::fill_n(add(draco::GeometryAttribute::GENERIC, 127, draco::DT_INT32, 508)->buffer()->data(),
                    size_t{508} * points, uint8_t{0});
    for (uint32_t i = 0; i < points; ++i) {
        const std::array<int32_t, 3> position{static_cast<int32_t>(i % side), static_cast<int32_t>(i / side),
                                              0};
        positions->SetAttributeValue(draco::AttributeValueIndex(i), position.data());
    }
    for (uint32_t i = 0; i + side < points; ++i) {
        if (i % side + 1 == side)
            continue;
        using Point = draco::PointIndex;
        mesh.AddFace({Point(i), Point(i + 1), Point(i + side)});
        mesh.AddFace({Point(i + 1), Point(i + side + 1), Point(i + side)});
    }
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

TEST(GltfDraco, AttributesThatDoNotFitIntoMemoryAreRefusedBeforeTheyAreMade) {
    if (!MemoryLimit::isPossible())
        GTEST_SKIP() << "memory cannot be limited here";
    const std::string file = dracoBuilder(dracoGrid(300)).glb();
    const MemoryLimit limit(uint64_t{64} << 20);
    const std::string error = importError(file);
    EXPECT_NE(
        error.find("mesh 0 \"part\" (KHR_draco_mesh_compression) has values which take 89 MiB of memory"),
        std::string::npos)
        << error;
}

TEST(GltfDraco, AttributesBeyondWhatAStreamCanFillAreRefusedBeforeTheyAreMade) {
    const std::string error = importError(dracoBuilder(dracoGrid(100, 24)));
    EXPECT_NE(error.find("122040000 bytes of values cannot be in its stream"), std::string::npos) << error;
}

TEST(GltfDraco, StreamThatManyPrimitivesNameCountsForEach) {
    GltfBuilder builder = dracoBuilder(dracoGrid(50)); // 4802 triangles
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives = std::vector<Json>(10'000, Json(primitives[0]));
    EXPECT_NE(importError(builder).find("state 48020000 triangles, at most 44739242 are supported"),
              std::string::npos);
}

TEST(GltfDraco, NoDamagedByteCrashesTheImport) {
    const std::string stream = dracoSquare();
    size_t refused = 0;
    for (size_t i = 0; i < stream.size(); ++i) {
        for (const int change : {0x01, 0x10, 0x80, 0xFF}) {
            std::string damaged = stream;
            damaged[i] = static_cast<char>(damaged[i] ^ change);
            refused += importError(dracoBuilder(damaged)).empty() ? 0 : 1;
        }
    }
    EXPECT_GT(refused, stream.size());
}

class Twins : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

// Bounds and triangle counts agree up to quantization.
TEST_P(Twins, CompressedFileShowsWhatThePlainOneShows) {
    const char* assets = std::getenv("LAVALIGHT_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "LAVALIGHT_ASSETS is not set: no compressed files";
    const Scene compressed = importGltf(std::filesystem::path(assets) / GetParam().first);
    const Scene plain = importGltf(std::filesystem::path(assets) / GetParam().second);
    EXPECT_EQ(compressed.triangleCount(), plain.triangleCount());
    const float tolerance = 0.005f * plain.bounds.radius();
    EXPECT_LT(glm::length(compressed.bounds.lower - plain.bounds.lower), tolerance);
    EXPECT_LT(glm::length(compressed.bounds.upper - plain.bounds.upper), tolerance);
    ASSERT_EQ(compressed.meshes.size(), plain.meshes.size());
    for (size_t i = 0; i < plain.meshes.size(); ++i)
        EXPECT_EQ(compressed.meshes[i].uvs.size(), plain.meshes[i].uvs.size());
}

INSTANTIATE_TEST_SUITE_P(
    Assets, Twins,
    ::testing::Values(std::pair{"Box/glTF-Draco/Box.gltf", "Box/glTF/Box.gltf"},
                      std::pair{"CesiumMilkTruck/glTF-Draco/CesiumMilkTruck.gltf",
                                "CesiumMilkTruck/glTF-Binary/CesiumMilkTruck.glb"},
                      std::pair{"Duck/glTF-Draco/Duck.gltf", "Duck/glTF-Binary/Duck.glb"},
                      std::pair{"MorphPrimitivesTest/glTF-Draco/MorphPrimitivesTest.gltf",
                                "MorphPrimitivesTest/glTF-Binary/MorphPrimitivesTest.glb"},
                      std::pair{"glTF-Transform-samples/BoxMeshopt/BoxMeshopt.glb", "Box/glTF/Box.gltf"},
                      std::pair{"gltf-pipeline-samples/EXT_meshopt_compression/no-fallback/"
                                "meshopt-no-fallback.gltf",
                                "gltf-pipeline-samples/EXT_meshopt_compression/fallback/"
                                "meshopt-fallback.gltf"}));

} // namespace
} // namespace lavalight::test
