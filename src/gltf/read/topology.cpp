// Triangle lists, strips and fans (glTF 2.0 specification, section 3.7.2.1).
#include "gltf/read/topology.h"

#include <optional>

#include <fmt/format.h>

namespace lavalight {
namespace {

// The vertex indices in the order of drawing: the index accessor's, or 0, 1, 2, ...
std::vector<uint32_t> readIndices(const GltfDocument& document, JsonView primitive, size_t vertexCount) {
    std::vector<uint32_t> indices;
    const std::optional<size_t> accessor = primitive.index("indices");
    if (!accessor) {
        indices.resize(vertexCount);
        for (size_t i = 0; i < vertexCount; ++i)
            indices[i] = static_cast<uint32_t>(i);
        return indices;
    }
    const AccessorView view(document, *accessor);
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

size_t cornerCount(JsonView primitive, const GltfDocument& document) {
    const std::optional<size_t> positions = primitive["attributes"].index("POSITION");
    if (!positions)
        return 0;
    const size_t accessor = primitive.index("indices").value_or(*positions);
    return document.list("accessors")[accessor].count("count", 0);
}

// Corner numbers of triangle i. Every odd triangle of a strip turns the other way round:
//
//   strip  0---2---4      fan   2---3        strip: 012, 132, 234, 354, ...
//           \ / \ / \          / \ /         fan:   120, 230, ...  (0 stays the last, as the specification
//           has it)
//            1---3---5        1---0
glm::uvec3 cornersOf(uint64_t mode, uint32_t i) {
    switch (mode) {
    case kTriangleStrip:
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    case kTriangleFan:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

} // namespace

uint64_t modeOf(JsonView primitive) {
    return primitive.count("mode", kTriangleList);
}

bool hasTriangles(JsonView primitive) {
    return modeOf(primitive) >= kTriangleList;
}

size_t triangleCount(JsonView primitive, const GltfDocument& document) {
    const size_t corners = cornerCount(primitive, document);
    if (modeOf(primitive) == kTriangleList)
        return corners / 3;
    return hasTriangles(primitive) && corners > 2 ? corners - 2 : 0;
}

std::vector<glm::uvec3> readTriangles(const GltfDocument& document, JsonView primitive, size_t vertexCount) {
    const std::vector<uint32_t> indices = readIndices(document, primitive, vertexCount);
    const size_t count = triangleCount(primitive, document);
    const uint64_t mode = modeOf(primitive);
    std::vector<glm::uvec3> triangles;
    triangles.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::uvec3 corners = cornersOf(mode, static_cast<uint32_t>(i));
        const glm::uvec3 triangle{indices[corners.x], indices[corners.y], indices[corners.z]};
        const bool joins = triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x;
        if (mode == kTriangleList || !joins)
            triangles.push_back(triangle);
    }
    return triangles;
}

} // namespace lavalight
