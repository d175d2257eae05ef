#include "session/next_frame.h"

#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "scene/world_position.h"

namespace lavalight {
namespace {

// What two frames of a mesh have in common: name, object, material, number of vertices.
using Likeness = std::tuple<std::string, uint32_t, uint32_t, size_t>;

Likeness likenessOf(const Mesh& mesh) {
    return {mesh.name, mesh.object, mesh.material, mesh.positions.size()};
}

} // namespace

NextFrame nextFrameOf(Scene& scene, const Scene& next, Camera camera) {
    std::map<Likeness, std::deque<const Mesh*>> later;
    for (const Mesh& mesh : next.meshes)
        later[likenessOf(mesh)].push_back(&mesh);
    camera.position = fromWorld(toWorld(camera.position, next.origin), scene.origin);
    NextFrame frame{{}, std::move(camera)};
    const glm::vec3 shift(next.origin - scene.origin);
    size_t still = 0;
    for (const Mesh& mesh : scene.meshes) {
        std::deque<const Mesh*>& alike = later[likenessOf(mesh)];
        std::vector<glm::vec3>& positions = frame.positions.emplace_back(mesh.positions);
        if (alike.empty()) {
            ++still;
            continue;
        }
        positions = alike.front()->positions;
        alike.pop_front();
        for (glm::vec3& position : positions)
            position += shift;
    }
    if (still > 0)
        scene.warnings.push_back(fmt::format(
            "the layer of motion shows {} meshes as still: the next frame has none with the same vertices",
            still));
    return frame;
}

} // namespace lavalight
