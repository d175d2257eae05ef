// Brings a mesh to world space and cleans it: no triangle leaves that has no area or no finite position.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/vertex_runs.h"

namespace lavalight {

// What baking changed, added up over meshes.
struct BakeCounts {
    uint64_t outOfRange = 0;       // triangles dropped: a position that is not finite or too large
    uint64_t withoutArea = 0;      // triangles dropped: no normal in single precision
    uint64_t repairedNormals = 0;  // vertices whose normal came from the triangles around
    uint64_t repairedTangents = 0; // vertices whose tangent had no direction and got one along the surface
};

// Takes vertices to world space.
class VertexTransform {
  public:
    explicit VertexTransform(const glm::dmat4& toWorld);

    // Vertex i with its normal and tangent, which may have any length before and have unit length, or none,
    // after. Returns its position before it is rounded to single precision.
    glm::dvec3 apply(Mesh& mesh, size_t vertex) const;
    [[nodiscard]] bool isMirrored() const { return isMirrored_; } // triangles must turn the other way

  private:
    glm::dmat4 toWorld_;
    glm::dmat3 normals_;
    bool isMirrored_;
};

// Drops triangles of a mesh in world space that cannot be rendered, and repairs normals and tangents without
// direction.
void cleanMesh(Mesh& mesh, BakeCounts& counts);

// `local` is a mesh in its own space, with normals and tangents of any length. The result's front faces turn
// counter-clockwise even where `toWorld` mirrors. `runs`, which has begun the mesh, gets the positions.
[[nodiscard]] Mesh bakeMesh(const Mesh& local, const glm::dmat4& toWorld, BakeCounts& counts,
                            VertexRuns& runs);

} // namespace lavalight
