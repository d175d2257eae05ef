// Reads the attributes of a primitive's vertices.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gltf/file/document.h"
#include "scene/scene.h"

namespace lavalight {

// The primitive's vertices. Throws Error, naming the mesh, where its attributes differ in their numbers.
// Requires POSITION.
[[nodiscard]] size_t countVertices(const GltfDocument& document, JsonView primitive, const std::string& name);

// The vertices of these numbers, which are below countVertices, as a mesh without triangles, with all
// attributes as in the file. Throws Error for an attribute whose accessor is of another type than glTF asks
// for.
[[nodiscard]] Mesh readVertices(const GltfDocument& document, JsonView primitive,
                                const std::vector<uint32_t>& vertices);

// A primitive's vertices of these numbers, which are below countVertices.
struct VertexSource {
    JsonView primitive;
    std::vector<uint32_t> vertices;
    glm::dvec3 anchor{0.0}; // what has been taken from their positions
};

// Takes a place among the positions from all of them, on each axis where they lie so far from 0 that morph
// targets would be rounded; returns it. Nothing of the positions is lost.
[[nodiscard]] glm::dvec3 takeAnchor(Mesh& mesh);

// Clamps colours to 0 .. 1 and makes texture coordinates finite: once, after all morph targets (glTF 2.0,
// 3.7.2.2), since what one target takes too far the next may bring back. `name` is the mesh's.
void limitVertices(Mesh& mesh, const std::string& name, GltfNotes& notes);

} // namespace lavalight
