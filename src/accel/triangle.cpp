// A scene's triangles by their corners.
#include "accel/triangle.h"

namespace lavalight {

std::vector<Triangle> sceneTriangles(const Scene& scene) {
    std::vector<Triangle> triangles;
    triangles.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes)
        for (const glm::uvec3& t : mesh.triangles)
            triangles.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
    return triangles;
}

} // namespace lavalight
