// A camera that is moved by hand: orbit, pan, dolly, fly.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight {

// A camera that is moved in a world whose +Y is up. The camera keeps its roll.
class CameraRig {
  public:
    // Orbits about the point in the middle of the image at the distance of the scene's middle.
    CameraRig(const Camera& camera, const Bounds& scene);

    [[nodiscard]] const Camera& camera() const { return camera_; }
    [[nodiscard]] const glm::vec3& pivot() const { return pivot_; }
    // Distance from the camera to the pivot, metres.
    [[nodiscard]] float distance() const;

    // Turns the camera about the pivot, radians to the right and up; never over the poles.
    void orbit(const glm::vec2& angles);
    // Turns the camera about itself; the pivot stays ahead of it.
    void look(const glm::vec2& angles);
    // Moves camera and pivot within the image plane, so that the pivot crosses that share of the image's
    // height. `aspect`: its width / height.
    void pan(const glm::vec2& share, float aspect);
    // Multiplies the distance to the pivot; an orthographic camera's view, instead.
    void dolly(float factor);
    // Moves camera and pivot along right, up and forward, metres.
    void fly(const glm::vec3& metres);

    // Turns the camera towards a point, and orbits about it from now on.
    void centreOn(const glm::vec3& point);
    // Focuses: what lies as far ahead as this point is sharp.
    void focusOn(const glm::vec3& point);
    // Counts its places from this one, which is relative to where they counted from.
    void moveOrigin(const glm::dvec3& origin);
    void setLens(float radius) { camera_.lensRadius = radius; }
    void setFocusDistance(float metres) { camera_.focusDistance = metres; }
    void setVerticalFov(float radians) {
        camera_.verticalFov = radians;
        camera_.intrinsics.reset();
    }

  private:
    void turn(const glm::vec2& angles, const glm::vec3& about);

    Camera camera_;
    glm::vec3 pivot_;
};

// Options (without dashes) of `lavalight render` that place a camera there, for an image of that width /
// height, in a scene of that origin.
[[nodiscard]] OptionPairs cameraOptions(const CameraRig& rig, float aspect, const glm::dvec3& origin);

// Where a point appears: (0, 0) is the image's top left corner, (1, 1) its bottom right one. Nothing for what
// lies behind a perspective camera. `aspect`: width / height.
[[nodiscard]] std::optional<glm::vec2> project(const Camera& camera, float aspect, const glm::vec3& point);

} // namespace lavalight
