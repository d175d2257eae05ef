// Placement of the framing camera: the distance at which all eight corners lie inside the field of view.
#include "scene/framing_camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace lavalight {
namespace {

constexpr double kVerticalFov = glm::pi<double>() / 4.0;
constexpr double kMargin = 1.05; // factor of the distance: the outermost corners keep off the image's border

// Offsets of the corners from the middle of a box.
glm::dvec3 cornerOffset(const glm::dvec3& halfSize, int corner) {
    return halfSize *
           glm::dvec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
}

} // namespace

Camera framingCamera(const Bounds& bounds) {
    const glm::dvec3 lower(bounds.lower);
    const glm::dvec3 upper(bounds.upper);
    const glm::dvec3 middle = 0.5 * (lower + upper);
    const glm::dvec3 size = upper - lower;
    const glm::dvec3 halfSize = glm::length(size) > 0.0 ? 0.5 * size : glm::dvec3(0.5);

    const glm::dvec3 forward = glm::normalize(glm::dvec3(-0.6, -0.45, -1.0));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(right, forward);

    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 offset = cornerOffset(halfSize, corner);
        const double aside = std::max(std::abs(glm::dot(offset, right)), std::abs(glm::dot(offset, up)));
        distance = std::max(distance, aside / std::tan(0.5 * kVerticalFov) - glm::dot(offset, forward));
    }

    Camera camera;
    camera.name = "framing";
    camera.framedAspect = 1.0f; // the corners are within a square
    camera.position = glm::vec3(middle - kMargin * distance * forward);
    camera.right = glm::vec3(right);
    camera.up = glm::vec3(up);
    camera.forward = glm::vec3(forward);
    camera.verticalFov = static_cast<float>(kVerticalFov);
    return camera;
}

} // namespace lavalight
