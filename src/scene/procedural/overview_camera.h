// The camera of a procedural scene.
#pragma once

#include "scene/scene.h"

namespace lavalight {

// A camera named "overview" with a square picture, which looks down along -Z; `down` metres for each metre
// ahead.
[[nodiscard]] inline Camera overviewCamera(const glm::vec3& position, float down) {
    Camera camera;
    camera.name = "overview";
    camera.position = position;
    camera.forward = glm::normalize(glm::vec3(0.0f, -down, -1.0f));
    camera.up = glm::normalize(glm::cross(camera.right, camera.forward));
    camera.aspect = 1.0f;
    camera.framedAspect = 1.0f;
    return camera;
}

} // namespace lavalight
