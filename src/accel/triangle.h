// A scene's triangles by their corners, in the numbering that every part shares.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

// A triangle in world space. Its front is where v0, v1, v2 turn counter-clockwise.
struct Triangle {
    glm::vec3 v0, v1, v2;
};

// All triangles: meshes in order, each mesh's triangles in order. An element's index is the triangle's id.
[[nodiscard]] std::vector<Triangle> sceneTriangles(const Scene& scene);

} // namespace lavalight
