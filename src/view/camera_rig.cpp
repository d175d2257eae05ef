#include "view/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "scene/look_at.h"
#include "scene/view_extent.h"
#include "scene/world_position.h"

namespace lavalight {
namespace {

constexpr glm::vec3 kUp(0.0f, 1.0f, 0.0f);

// Radians that the direction of view keeps from the poles, where left and right would change places.
constexpr float kPoleMargin = 0.02f;

// What an image of this aspect ratio shows, whatever its pixels.
ViewExtent extentAt(const Camera& camera, float aspect) {
    constexpr float kManyRows = 65536.0f;
    return viewExtent(camera, aspect * kManyRows, kManyRows);
}

float elevation(const glm::vec3& direction) {
    return std::asin(std::clamp(direction.y, -1.0f, 1.0f));
}

// Makes the axes right-handed and orthonormal again, whatever rounding did.
void straighten(Camera& camera) {
    camera.forward = glm::normalize(camera.forward);
    camera.right = glm::normalize(glm::cross(camera.forward, camera.up));
    camera.up = glm::cross(camera.right, camera.forward);
}

} // namespace

CameraRig::CameraRig(const Camera& camera, const Bounds& scene) : camera_(camera) {
    const float ahead = glm::dot(scene.center() - camera.position, camera.forward);
    const float least = std::max(1e-3f * scene.radius(), 1e-6f);
    pivot_ = camera.position + camera.forward * std::max(ahead, least);
}

float CameraRig::distance() const {
    return glm::length(pivot_ - camera_.position);
}

void CameraRig::turn(const glm::vec2& angles, const glm::vec3& about) {
    const float now = elevation(camera_.forward);
    const float limit = 0.5f * std::numbers::pi_v<float> - kPoleMargin;
    const float pitch = std::clamp(now + angles.y, std::min(-limit, now), std::max(limit, now)) - now;
    const glm::quat turned = glm::angleAxis(-angles.x, kUp) * glm::angleAxis(pitch, camera_.right);
    camera_.forward = turned * camera_.forward;
    camera_.up = turned * camera_.up;
    straighten(camera_);
    camera_.position = about + turned * (camera_.position - about);
}

void CameraRig::orbit(const glm::vec2& angles) {
    turn(angles, pivot_);
}

void CameraRig::look(const glm::vec2& angles) {
    const glm::vec3 offset = pivot_ - camera_.position;
    const float ahead = glm::dot(offset, camera_.forward);
    turn(angles, camera_.position);
    pivot_ = camera_.position + camera_.forward * ahead;
}

void CameraRig::pan(const glm::vec2& share, float aspect) {
    const float scale = camera_.projection == Projection::orthographic ? 1.0f : distance();
    const float height = 2.0f * extentAt(camera_, aspect).halfHeight * scale;
    fly({-share.x * height, share.y * height, 0.0f});
}

void CameraRig::dolly(float factor) {
    if (camera_.projection == Projection::orthographic)
        camera_.halfHeight *= factor;
    else
        camera_.position = pivot_ + (camera_.position - pivot_) * factor;
}

void CameraRig::fly(const glm::vec3& metres) {
    const glm::vec3 way = camera_.right * metres.x + camera_.up * metres.y + camera_.forward * metres.z;
    camera_.position += way;
    pivot_ += way;
}

void CameraRig::centreOn(const glm::vec3& point) {
    if (const auto aimed = lookAtCamera(camera_.position, point, kUp)) {
        camera_.forward = aimed->forward;
        camera_.right = aimed->right;
        camera_.up = aimed->up;
        pivot_ = point;
    }
}

void CameraRig::focusOn(const glm::vec3& point) {
    const float ahead = glm::dot(point - camera_.position, camera_.forward);
    if (ahead > 0.0f)
        camera_.focusDistance = ahead;
}

void CameraRig::moveOrigin(const glm::dvec3& origin) {
    camera_.position = fromWorld(glm::dvec3(camera_.position), origin);
    pivot_ = fromWorld(glm::dvec3(pivot_), origin);
}

OptionPairs cameraOptions(const CameraRig& rig, float aspect, const glm::dvec3& origin) {
    const Camera& camera = rig.camera();
    OptionPairs options{{"look-from", worldText(camera.position, origin)},
                        {"look-at", worldText(rig.pivot(), origin)},
                        {"up", worldText(camera.up, glm::dvec3(0.0))}};
    if (camera.projection == Projection::perspective)
        options.emplace_back(
            "fov", fmt::format("{}", glm::degrees(2.0f * std::atan(extentAt(camera, aspect).halfHeight))));
    if (camera.lensRadius > 0.0f) {
        options.emplace_back("aperture", fmt::format("{}", 2.0f * camera.lensRadius));
        options.emplace_back("focus", fmt::format("{}", camera.focusDistance));
    }
    if (camera.projection == Projection::panorama)
        options.emplace_back("panorama", "on");
    return options;
}

std::optional<glm::vec2> project(const Camera& camera, float aspect, const glm::vec3& point) {
    const glm::vec3 offset = point - camera.position;
    const glm::vec3 local(glm::dot(offset, camera.right), glm::dot(offset, camera.up),
                          glm::dot(offset, camera.forward));
    if (camera.projection == Projection::panorama) {
        // A panorama has the world's axes, as in lib/math/equirectangular.glsl.
        constexpr float kPi = std::numbers::pi_v<float>;
        const glm::vec3 direction = glm::normalize(offset);
        const float u = 0.5f + std::atan2(direction.z, direction.x) / (2.0f * kPi);
        return glm::vec2(u, std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / kPi);
    }
    const bool isPerspective = camera.projection == Projection::perspective;
    if (isPerspective && local.z <= 0.0f)
        return std::nullopt;
    const ViewExtent view = extentAt(camera, aspect);
    const float scale = isPerspective ? local.z : 1.0f;
    const glm::vec2 plane(local.x / (view.halfWidth * scale), local.y / (view.halfHeight * scale));
    return glm::vec2(0.5f + 0.5f * plane.x, 0.5f - 0.5f * plane.y);
}

} // namespace lavalight
