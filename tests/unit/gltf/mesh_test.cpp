// Tests of how the import reads vertices, indices and topologies.
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// Five corners of a zigzag in the plane z = 0, as a strip has them.
const std::vector<glm::vec3> kZigzag = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};

Scene importPrimitive(GltfBuilder& builder, Json primitive) {
    builder.addNode({{"mesh", builder.addMesh(std::move(primitive))}});
    return builder.import();
}

TEST(GltfMesh, AllTrianglesOfAStripFaceTheSameWay) {
    GltfBuilder builder;
    const Scene scene =
        importPrimitive(builder, {{"attributes", {{"POSITION", builder.addVec3(kZigzag)}}}, {"mode", 5}});
    ASSERT_EQ(scene.triangleCount(), 3u);
    for (size_t i = 0; i < 3; ++i)
        EXPECT_GT(frontOf(scene.meshes[0], i).z, 0.9f) << "triangle " << i;
}

TEST(GltfMesh, AllTrianglesOfAFanFaceTheSameWayAndShareTheFirstVertex) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}});
    const Scene scene = importPrimitive(builder, {{"attributes", {{"POSITION", positions}}}, {"mode", 6}});
    ASSERT_EQ(scene.triangleCount(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_GT(frontOf(scene.meshes[0], i).z, 0.9f) << "triangle " << i;
        EXPECT_EQ(cornersOf(scene.meshes[0])[i][2], glm::vec3(0.0f));
    }
}

TEST(GltfMesh, JoinsOfAStripAreNoTrianglesAndNoWarning) {
    GltfBuilder builder;
    const int indices = builder.addIndices<uint16_t>({0, 1, 2, 2, 3, 3, 4}, kUnsignedShort);
    const Scene scene = importPrimitive(
        builder,
        {{"attributes", {{"POSITION", builder.addVec3(kZigzag)}}}, {"indices", indices}, {"mode", 5}});
    EXPECT_EQ(scene.triangleCount(), 1u);
    EXPECT_EQ(warningsWith(scene, "without area"), 0);
}

TEST(GltfMesh, PointsAndLinesAreSkippedWithOneWarningThatNamesTheMesh) {
    GltfBuilder builder;
    const int positions = builder.addVec3(kZigzag);
    const int mesh = builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"mode", 0}});
    for (const int mode : {1, 2, 3})
        builder.json["meshes"][0]["primitives"].push_back(
            {{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    builder.addNode({{"mesh", mesh}});
    builder.addNode({{"mesh", mesh}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.triangleCount(), 0u);
    EXPECT_EQ(warningsWith(scene, "points and lines"), 1);
    EXPECT_EQ(warningsWith(scene, "points and lines are not rendered: mesh 0 \"part\""), 1);
}

template <class T>
void expectIndicesOf(int componentType) {
    GltfBuilder builder;
    const int indices = builder.addIndices<T>({4, 3, 2, 0, 1, 2}, componentType);
    const Scene scene = importPrimitive(
        builder, {{"attributes", {{"POSITION", builder.addVec3(kZigzag)}}}, {"indices", indices}});
    ASSERT_EQ(scene.triangleCount(), 2u) << componentType;
    const auto corners = cornersOf(scene.meshes[0]);
    EXPECT_EQ(corners[0], (std::array{kZigzag[4], kZigzag[3], kZigzag[2]}));
    EXPECT_EQ(corners[1], (std::array{kZigzag[0], kZigzag[1], kZigzag[2]}));
}

TEST(GltfMesh, AllIndexTypesMeanTheSame) {
    expectIndicesOf<uint8_t>(kUnsignedByte);
    expectIndicesOf<uint16_t>(kUnsignedShort);
    expectIndicesOf<uint32_t>(kUnsignedInt);
}

TEST(GltfMesh, MeshWithoutIndicesTakesItsVerticesInOrderAndIsFlat) {
    GltfBuilder builder;
    builder.addNode({{"mesh", builder.addTriangle()}});
    const Scene scene = builder.import();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangles[0], glm::uvec3(0, 1, 2));
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    EXPECT_EQ(scene.bounds.lower, glm::vec3(0.0f));
    EXPECT_EQ(scene.bounds.upper, glm::vec3(1.0f, 1.0f, 0.0f));
}

TEST(GltfMesh, VerticesThatNoTriangleUsesAreLeftOut) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {0, 1, 0}});
    const int indices = builder.addIndices<uint8_t>({1, 2, 4}, kUnsignedByte);
    const Scene scene =
        importPrimitive(builder, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    EXPECT_EQ(scene.meshes.at(0).positions.size(), 3u);
    EXPECT_EQ(scene.bounds.upper, glm::vec3(1.0f, 1.0f, 0.0f));
}

// One vertex position of a triangle, stored as integers of type T.
template <class T>
glm::vec3 integerPosition(int componentType, bool normalized, std::array<T, 3> value) {
    GltfBuilder builder;
    const T one = std::numeric_limits<T>::max();
    std::vector<T> values(value.begin(), value.end());
    values.push_back(0); // elements of 4 components' size: their stride must be a multiple of 4 bytes
    for (const T component : {one, T{0}, T{0}, T{0}, T{0}, one, T{0}, T{0}})
        values.push_back(component);
    const int view = builder.addView(values);
    builder.json["bufferViews"][0]["byteStride"] = 4 * sizeof(T);
    const int positions = builder.addAccessor({{"bufferView", view},
                                               {"componentType", componentType},
                                               {"normalized", normalized},
                                               {"count", 3},
                                               {"type", "VEC3"}});
    return importPrimitive(builder, {{"attributes", {{"POSITION", positions}}}}).meshes.at(0).positions.at(0);
}

TEST(GltfMesh, NormalizedIntegersSpanTheirRange) {
    EXPECT_EQ(integerPosition<int8_t>(kByte, true, {127, -127, -128}), glm::vec3(1.0f, -1.0f, -1.0f));
    EXPECT_EQ(integerPosition<uint8_t>(kUnsignedByte, true, {255, 0, 51}), glm::vec3(1.0f, 0.0f, 0.2f));
    EXPECT_EQ(integerPosition<int16_t>(kShort, true, {32767, -32767, -32768}), glm::vec3(1.0f, -1.0f, -1.0f));
    EXPECT_EQ(integerPosition<uint16_t>(kUnsignedShort, true, {65535, 0, 13107}),
              glm::vec3(1.0f, 0.0f, 0.2f));
}

TEST(GltfMesh, PlainIntegersKeepTheirValue) {
    EXPECT_EQ(integerPosition<int8_t>(kByte, false, {5, -7, -128}), glm::vec3(5.0f, -7.0f, -128.0f));
    EXPECT_EQ(integerPosition<uint16_t>(kUnsignedShort, false, {5, 60000, 9}),
              glm::vec3(5.0f, 60000.0f, 9.0f));
}

TEST(GltfMesh, InterleavedAttributesAreReadByTheirStride) {
    GltfBuilder builder;
    const glm::vec3 up(0.0f, 0.0f, 1.0f);
    const int view = builder.addView<glm::vec3>({{0, 0, 0}, up, {1, 0, 0}, up, {0, 1, 0}, up});
    builder.json["bufferViews"][0]["byteStride"] = 24;
    const Json accessor = {{"bufferView", view}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}};
    const int positions = builder.addAccessor(accessor);
    const int normals = builder.addAccessor(accessor);
    builder.json["accessors"][1]["byteOffset"] = 12;
    const Scene scene =
        importPrimitive(builder, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    EXPECT_EQ(scene.meshes.at(0).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.meshes.at(0).normals, std::vector<glm::vec3>(3, up));
}

Json sparseElements(GltfBuilder& builder, const std::vector<uint8_t>& indices,
                    const std::vector<glm::vec3>& values) {
    return {{"count", indices.size()},
            {"indices", {{"bufferView", builder.addView(indices)}, {"componentType", kUnsignedByte}}},
            {"values", {{"bufferView", builder.addView(values)}}}};
}

TEST(GltfMesh, SparseElementsReplaceThoseOfTheBuffer) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const Json sparse = sparseElements(builder, {2}, {{0, 5, 0}});
    builder.json["accessors"][0]["sparse"] = sparse;
    const Scene scene = importPrimitive(builder, {{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(scene.meshes.at(0).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 5, 0}}));
}

TEST(GltfMesh, AccessorWithoutABufferViewIsZeroWhereNoSparseElementIs) {
    GltfBuilder builder;
    const Json sparse = sparseElements(builder, {1, 2}, {{3, 0, 0}, {0, 4, 0}});
    const int positions =
        builder.addAccessor({{"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
    const Scene scene = importPrimitive(builder, {{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(scene.meshes.at(0).positions, (std::vector<glm::vec3>{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}));
}

TEST(GltfMesh, IndicesWithoutABufferViewAreZeroAndMakeNoTriangle) {
    GltfBuilder builder;
    const int indices =
        builder.addAccessor({{"componentType", kUnsignedByte}, {"count", 3}, {"type", "SCALAR"}});
    const Scene scene = importPrimitive(
        builder, {{"attributes", {{"POSITION", builder.addVec3(kZigzag)}}}, {"indices", indices}});
    EXPECT_EQ(scene.triangleCount(), 0u);
    EXPECT_EQ(warningsWith(scene, "1 triangles without area"), 1);
}

TEST(GltfMesh, IncompleteLastTriangleIsLeftOutWithAWarning) {
    GltfBuilder builder;
    const int indices = builder.addIndices<uint8_t>({0, 1, 2, 1}, kUnsignedByte);
    const Scene scene = importPrimitive(
        builder, {{"attributes", {{"POSITION", builder.addVec3(kZigzag)}}}, {"indices", indices}});
    EXPECT_EQ(scene.triangleCount(), 1u);
    EXPECT_EQ(warningsWith(scene, "incomplete"), 1);
}

TEST(GltfMesh, TrianglesWithUnusablePositionsAreLeftOutAndCounted) {
    GltfBuilder builder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int positions = builder.addVec3(
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {HUGE_VALF, 0, 0}, {0, 2e18f, 0}, {0, 2, 0}});
    const int indices =
        builder.addIndices<uint8_t>({0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5, 0, 2, 6, 1, 2, 6}, kUnsignedByte);
    const Scene scene =
        importPrimitive(builder, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    EXPECT_EQ(scene.triangleCount(), 2u);
    EXPECT_EQ(scene.meshes.at(0).positions.size(), 4u); // the bad vertices have gone too
    EXPECT_EQ(warningsWith(scene, "3 triangles were left out: positions"), 1);
    EXPECT_EQ(warningsWith(scene, "1 triangles without area"), 1);
}

TEST(GltfMesh, BrokenNormalsAreReplacedByThoseOfTheTriangles) {
    GltfBuilder builder;
    const glm::vec3 tilted = glm::normalize(glm::vec3(1, 0, 1));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normals = builder.addVec3({{0, 0, 0}, 3.0f * tilted, {nan, 0, 1}});
    const Scene scene =
        importPrimitive(builder, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    const std::vector<glm::vec3>& read = scene.meshes.at(0).normals;
    EXPECT_EQ(read.at(0), glm::vec3(0, 0, 1));
    EXPECT_NEAR(glm::length(read.at(1) - tilted), 0.0f, 1e-6f);
    EXPECT_EQ(read.at(2), glm::vec3(0, 0, 1));
    EXPECT_EQ(warningsWith(scene, "2 normals"), 1);
}

TEST(GltfMesh, MeshWhoseNormalsAreAllZeroIsFlat) {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normals = builder.addVec3({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    const Scene scene =
        importPrimitive(builder, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    EXPECT_TRUE(scene.meshes.at(0).normals.empty());
}

} // namespace
} // namespace lavalight::test
