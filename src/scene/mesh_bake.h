// Brings a mesh to world space and cleans it: no triangle leaves that has no area or no finite position.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

// What baking changed, added up over meshes.
struct BakeCounts {
    uint64_t outOfRange = 0;       // triangles dropped: a position that is not finite or too large
    uint64_t withoutArea = 0;      // triangles dropped: no normal in single precision
    uint64_t repairedNormals = 0;  // vertices whose normal came from the triangles around
    uint64_t repairedTangents = 0; // vertices whose tangent had no direction and got one along the surface
};

// `local` is a mesh in its own space, with normals and tangents of any length. The result's front faces turn
// counter-clockwise even where `toWorld` mirrors.
[[nodiscard]] Mesh bakeMesh(const Mesh& local, const glm::dmat4& toWorld, BakeCounts& counts);

} // namespace lavalight
