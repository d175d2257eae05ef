// The bodies of a scene that have an inside (KHR_materials_volume).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

// Whether light passes through surfaces of the material to the inside of a volume.
[[nodiscard]] bool boundsSolid(const Material& material);

// Fills Scene::solids, Scene::openSolids and Mesh::solid. A mesh bounds a body if its vertices, welded where
// they coincide, leave no open edge, its fronts are outside, and no alpha lets rays through. Meshes of one
// medium that are closed together are one body. Bodies are numbered by the volumes of their bounding boxes,
// then by their meshes: where several overlap, the medium is that of the first.
void findSolids(Scene& scene);

// The solids that a point lies in.
struct SolidsAround {
    std::vector<uint32_t> numbers; // ascending, each as often as its surface goes around the point
    bool isOnSurface = false;      // the point is on a surface, where either side is as right
};
[[nodiscard]] SolidsAround solidsAround(const Scene& scene, const glm::dvec3& point);

} // namespace lavalight
