// Closed triangle meshes whose inside is known, for tests of rays.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight::test {

// Neighbouring triangles share vertices, fronts face outward, and the origin is inside.
struct ClosedMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

// The cube [-1, 1]^3, two triangles a face.
[[nodiscard]] ClosedMesh makeCube();
// The cube with `cells` x `cells` squares a face: edges lie in the planes between the boxes of a BVH.
[[nodiscard]] ClosedMesh makeGriddedCube(uint32_t cells);
// An icosahedron in the unit sphere, each triangle split in four `subdivisions` times: convex.
[[nodiscard]] ClosedMesh makeIcosphere(uint32_t subdivisions);
// Vertices moved along their radius by up to `amount` of it: every ray from the origin still hits once, not
// convex.
[[nodiscard]] ClosedMesh displaced(ClosedMesh mesh, float amount, uint32_t seed);

// Where and how large a test sets its mesh.
struct Placement {
    float scale;
    float distance; // distance between the mesh's origin and the world's, in units of the scale
    [[nodiscard]] glm::vec3 centre() const;
    [[nodiscard]] std::string name() const;
};

// Placements from millimetres to kilometres, at the origin and ten thousand sizes from it.
constexpr Placement kPlacements[] = {{1.0f, 0.0f}, {0.001f, 0.0f}, {1000.0f, 0.0f},
                                     {1.0f, 1e4f}, {0.001f, 1e4f}, {1000.0f, 1e4f}};

// The mesh with every position p moved to scale * p + centre, rounded: still closed.
[[nodiscard]] ClosedMesh placed(ClosedMesh mesh, const Placement& placement);

// A scene of this one mesh, flat shaded, of the default material.
[[nodiscard]] Scene sceneOf(const ClosedMesh& mesh);

} // namespace lavalight::test
