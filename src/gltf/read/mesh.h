// Reads the meshes of a glTF file and bakes their instances to world space.
#pragma once

#include <vector>

#include "gltf/file/document.h"
#include "gltf/read/nodes.h"
#include "scene/scene.h"
#include "scene/vertex_runs.h"

namespace lavalight {

struct Geometry {
    std::vector<Mesh> meshes;
    std::vector<std::string> objects; // names of the nodes that show them: Mesh::object
    VertexRuns runs;                  // before anything was rounded or dropped
};

// One Mesh per primitive and node (or instance) that shows it, morphed and skinned in the tree's pose,
// without meshes that have no triangles. All positions are finite and used by a triangle, and every triangle
// has a normal in single precision; what was dropped or repaired is noted. Meshes whose materials want
// tangents have them, if they have the uvs. Primitives without a material get the last of `materials`. Throws
// Error for data that does not fit together, and for more triangles than the renderer or memory could hold.
[[nodiscard]] Geometry readMeshes(const GltfDocument& document, const NodeTree& tree,
                                  const std::vector<Material>& materials, GltfNotes& notes);

} // namespace lavalight
