// Vertex attributes (glTF 2.0 specification, section 3.7.2.1; KHR_mesh_quantization widens the types of their
// components, which accessors read whatever they are).
#include "gltf/read/vertices.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "gltf/decode/accessor.h"

namespace lavalight {
namespace {

// Sets beyond are not read. Files of today have up to four; materials name one a texture.
constexpr size_t kMostUvSets = 16;

class VertexReader {
  public:
    VertexReader(const GltfDocument& document, JsonView primitive, const std::vector<uint32_t>& vertices)
        : document_(document), attributes_(primitive["attributes"]), vertices_(vertices) {}

    [[nodiscard]] std::vector<glm::vec2> vec2s(const std::string& attribute) const {
        return read<glm::vec2>(attribute, &AccessorView::isVec2, &AccessorView::vec2At);
    }
    [[nodiscard]] std::vector<glm::vec3> vec3s(const std::string& attribute) const {
        return read<glm::vec3>(attribute, &AccessorView::isVec3, &AccessorView::vec3At);
    }
    [[nodiscard]] std::vector<glm::vec4> vec4s(const std::string& attribute) const {
        return read<glm::vec4>(attribute, &AccessorView::isVec4, &AccessorView::vec4At);
    }
    [[nodiscard]] bool isVec3(const std::string& attribute) const {
        const std::optional<size_t> accessor = attributes_.index(attribute);
        return accessor && AccessorView(document_, *accessor).isVec3();
    }

  private:
    // Nothing where the primitive lacks the attribute.
    template <class Vector>
    [[nodiscard]] std::vector<Vector> read(const std::string& attribute,
                                           bool (AccessorView::*isRight)() const,
                                           Vector (AccessorView::*at)(size_t) const) const {
        std::vector<Vector> values;
        const std::optional<size_t> accessor = attributes_.index(attribute);
        if (!accessor)
            return values;
        const AccessorView view(document_, *accessor);
        if (!(view.*isRight)())
            throw document_.error(fmt::format("{} is used as {} and must be a VEC{}", view.name(), attribute,
                                              Vector::length()));
        values.reserve(vertices_.size());
        for (const uint32_t vertex : vertices_)
            values.push_back((view.*at)(vertex));
        return values;
    }

    const GltfDocument& document_;
    JsonView attributes_;
    const std::vector<uint32_t>& vertices_;
};

std::vector<std::vector<glm::vec2>> readUvs(const VertexReader& reader) {
    std::vector<std::vector<glm::vec2>> uvs;
    for (size_t set = 0; set < kMostUvSets; ++set) {
        std::vector<glm::vec2> values = reader.vec2s(fmt::format("TEXCOORD_{}", set));
        if (values.empty())
            continue;
        uvs.resize(set + 1);
        uvs.back() = std::move(values);
    }
    return uvs;
}

std::vector<glm::vec4> readColors(const VertexReader& reader) {
    std::vector<glm::vec4> colors;
    if (reader.isVec3("COLOR_0")) {
        for (const glm::vec3& color : reader.vec3s("COLOR_0"))
            colors.emplace_back(color, 1.0f);
    } else {
        colors = reader.vec4s("COLOR_0");
    }
    return colors;
}

} // namespace

size_t countVertices(const GltfDocument& document, JsonView primitive, const std::string& name) {
    const JsonView attributes = primitive["attributes"];
    const auto countOf = [&](const std::string& attribute) {
        return document.list("accessors")[attributes.count(attribute, 0)].count("count", 0);
    };
    const size_t vertexCount = countOf("POSITION");
    for (const auto& [attribute, accessor] : attributes.members()) {
        if (countOf(attribute) != vertexCount)
            throw document.error(fmt::format("{} has {} vertices but {} elements of {}", name, vertexCount,
                                             countOf(attribute), attribute));
    }
    return vertexCount;
}

Mesh readVertices(const GltfDocument& document, JsonView primitive, const std::vector<uint32_t>& vertices) {
    const VertexReader reader(document, primitive, vertices);
    Mesh mesh;
    mesh.positions = reader.vec3s("POSITION");
    mesh.normals = reader.vec3s("NORMAL");
    mesh.uvs = readUvs(reader);
    mesh.colors = readColors(reader);
    mesh.tangents = reader.vec4s("TANGENT");
    return mesh;
}

glm::dvec3 takeAnchor(Mesh& mesh) {
    constexpr float kFar = 256.0f; // sizes of the mesh: then the difference of two coordinates is exact
    glm::dvec3 anchor(0.0);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const auto [least, greatest] =
            std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                                [axis](const glm::vec3& a, const glm::vec3& b) { return a[axis] < b[axis]; });
        const float at = (*least)[axis];
        if (!(std::abs(at) > kFar * ((*greatest)[axis] - at)) || !std::isfinite(at))
            continue;
        anchor[axis] = at;
        for (glm::vec3& position : mesh.positions)
            position[axis] -= at;
    }
    return anchor;
}

void limitVertices(Mesh& mesh, const std::string& name, GltfNotes& notes) {
    for (glm::vec4& color : mesh.colors) // a false comparison makes NaN a 0
        for (int channel = 0; channel < 4; ++channel)
            color[channel] = color[channel] > 0.0f ? std::min(color[channel], 1.0f) : 0.0f;
    for (std::vector<glm::vec2>& set : mesh.uvs)
        for (glm::vec2& uv : set) {
            if (std::isfinite(uv.x) && std::isfinite(uv.y))
                continue;
            uv = glm::vec2(0.0f);
            notes.addObject("texture coordinates that are not finite were taken as 0", name);
        }
}

} // namespace lavalight
