// Triangle lists, strips and fans (glTF 2.0 specification, section 3.7.2.1).
#include "gltf/read/topology.h"

#include <fmt/format.h>

namespace lavalight {
namespace {

// The vertex indices in the order of drawing: the index accessor's, or 0, 1, 2, ...
std::vector<uint32_t> readIndices(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                  size_t vertexCount) {
    std::vector<uint32_t> indices;
    if (primitive.indices < 0) {
        indices.resize(vertexCount);
        for (size_t i = 0; i < vertexCount; ++i)
            indices[i] = static_cast<uint32_t>(i);
        return indices;
    }
    const AccessorView view(document, primitive.indices);
    if (!view.isUnsignedScalar())
        throw document.error(view.name() + " holds no indices: it must be a SCALAR of an unsigned type");
    indices.resize(view.count());
    for (size_t i = 0; i < indices.size(); ++i) {
        indices[i] = view.unsignedAt(i);
        if (indices[i] >= vertexCount)
            throw document.error(fmt::format("{} has the index {} at {}, but there are {} vertices",
                                             view.name(), indices[i], i, vertexCount));
    }
    return indices;
}

size_t cornerCount(const tinygltf::Primitive& primitive, const GltfDocument& document) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end())
        return 0;
    const int accessor = primitive.indices >= 0 ? primitive.indices : position->second;
    return document.model.accessors.at(static_cast<size_t>(accessor)).count;
}

// Corner numbers of triangle i. Every odd triangle of a strip turns the other way round:
//
//   strip  0---2---4      fan   2---3        strip: 012, 132, 234, 354, ...
//           \ / \ / \          / \ /         fan:   120, 230, ...  (0 stays the last, as the specification
//           has it)
//            1---3---5        1---0
glm::uvec3 cornersOf(int mode, uint32_t i) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

} // namespace

bool hasTriangles(const tinygltf::Primitive& primitive) {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES;
}

size_t triangleCount(const tinygltf::Primitive& primitive, const GltfDocument& document) {
    const size_t corners = cornerCount(primitive, document);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES)
        return corners / 3;
    return hasTriangles(primitive) && corners > 2 ? corners - 2 : 0;
}

std::vector<glm::uvec3> readTriangles(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                      size_t vertexCount) {
    const std::vector<uint32_t> indices = readIndices(document, primitive, vertexCount);
    const size_t count = triangleCount(primitive, document);
    std::vector<glm::uvec3> triangles;
    triangles.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::uvec3 corners = cornersOf(primitive.mode, static_cast<uint32_t>(i));
        const glm::uvec3 triangle{indices[corners.x], indices[corners.y], indices[corners.z]};
        const bool joins = triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x;
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES || !joins)
            triangles.push_back(triangle);
    }
    return triangles;
}

} // namespace lavalight
