#include "device_scene/triangle_layers.h"

#include <array>
#include <cassert>

namespace lavalight {
namespace {

TriangleLayers layersOf(const Mesh& mesh, const std::vector<glm::vec3>& next, const glm::uvec3& triangle) {
    TriangleLayers layers{};
    const std::array<glm::vec2*, 3> uvs{&layers.uv0, &layers.uv1, &layers.uv2};
    for (glm::length_t corner = 0; corner < 3; ++corner) {
        const uint32_t vertex = triangle[corner];
        if (!mesh.uvs.empty() && !mesh.uvs.front().empty())
            *uvs[static_cast<size_t>(corner)] = mesh.uvs.front()[vertex];
        for (glm::length_t axis = 0; axis < 3; ++axis)
            layers.next[3 * corner + axis] = next[vertex][axis];
    }
    return layers;
}

} // namespace

std::vector<TriangleLayers> triangleLayers(const Scene& scene) {
    std::vector<TriangleLayers> layers;
    layers.reserve(scene.triangleCount());
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const std::vector<glm::vec3>& next = scene.next ? scene.next->positions[i] : mesh.positions;
        assert(next.size() == mesh.positions.size());
        for (const glm::uvec3& triangle : mesh.triangles)
            layers.push_back(layersOf(mesh, next, triangle));
    }
    return layers;
}

SurfaceIds surfaceIds(const Scene& scene) {
    SurfaceIds ids;
    ids.objects.reserve(scene.triangleCount());
    ids.materials.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes) {
        ids.objects.insert(ids.objects.end(), mesh.triangles.size(), mesh.object + 1);
        ids.materials.insert(ids.materials.end(), mesh.triangles.size(), mesh.material + 1);
    }
    return ids;
}

} // namespace lavalight
