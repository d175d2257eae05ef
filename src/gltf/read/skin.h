// Skins: vertices that follow several joints.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gltf/file/document.h"
#include "gltf/read/vertices.h"
#include "scene/scene.h"
#include "scene/vertex_runs.h"

namespace lavalight {

// From the space of the vertices to the world, by joint. `toWorld` has the transforms of all nodes. Throws
// Error for inverse bind matrices that are too few or of another type.
[[nodiscard]] std::vector<glm::dmat4> jointTransforms(const GltfDocument& document, size_t skin,
                                                      const std::vector<glm::dmat4>& toWorld);

// Whether the primitive says which joints move it.
[[nodiscard]] bool hasJoints(JsonView primitive);

// Brings `mesh`, whose vertices are those of the source, to world space: each vertex by the mean of its
// joints' transforms (JOINTS_n, WEIGHTS_n), normals by its inverse transpose. The node's own transform has no
// part in it, as the specification has it. `runs`, which has begun the mesh, gets the positions. Throws Error
// for joints that the skin does not have and for attributes of another type.
void applySkin(const GltfDocument& document, const VertexSource& source,
               const std::vector<glm::dmat4>& joints, Mesh& mesh, VertexRuns& runs);

} // namespace lavalight
