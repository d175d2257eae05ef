#include "scene/look_at.h"

#include <cmath>

namespace lavalight {

std::optional<Camera> lookAtCamera(const glm::vec3& from, const glm::vec3& at, const glm::vec3& up) {
    constexpr double kParallel =
        1e-6; // sine of the angle between view and up: less leaves no digits of `right`
    const glm::dvec3 view = glm::dvec3(at) - glm::dvec3(from);
    const glm::dvec3 side = glm::cross(view, glm::dvec3(up));
    const double limit = kParallel * glm::length(view) * glm::length(glm::dvec3(up));
    if (!(glm::length(side) > limit) || !std::isfinite(glm::length(side)))
        return std::nullopt;
    const glm::dvec3 forward = glm::normalize(view);
    const glm::dvec3 right = glm::normalize(side);
    Camera camera;
    camera.name = "look-at";
    camera.position = from;
    camera.forward = glm::vec3(forward);
    camera.right = glm::vec3(right);
    camera.up = glm::vec3(glm::cross(right, forward));
    camera.verticalFov = glm::radians(45.0f);
    return camera;
}

} // namespace lavalight
