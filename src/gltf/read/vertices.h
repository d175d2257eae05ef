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

// The vertices of these numbers, which are below countVertices, as a mesh without triangles. Positions,
// normals and tangents are as in the file; uvs are finite, colours from 0 to 1. `name` is the mesh's. Throws
// Error for an attribute whose accessor is of another type than glTF asks for.
[[nodiscard]] Mesh readVertices(const GltfDocument& document, JsonView primitive,
                                const std::vector<uint32_t>& vertices, const std::string& name,
                                GltfNotes& notes);

} // namespace lavalight
