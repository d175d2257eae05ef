#include "scene/framing_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>

namespace lavalight {
namespace {

constexpr double kVerticalFov = glm::pi<double>() / 4.0;
constexpr double kMargin = 1.05; // factor of the distance: the outermost corners keep off the image's border
constexpr double kViewMargin =
    1.1; // of the image's half sides to the outermost vertices' distance from its middle

// Offsets of the corners from the middle of a box.
glm::dvec3 cornerOffset(const glm::dvec3& halfSize, int corner) {
    return halfSize *
           glm::dvec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
}

// Axes of a camera.
struct Axes {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;
};

const glm::dvec3 kThreeQuarter(-0.6, -0.45, -1.0);

// Axes of a camera that looks along `forward`, and sees +Y upwards.
Axes levelAxes(const glm::dvec3& forward) {
    const glm::dvec3 f = glm::normalize(forward);
    const glm::dvec3 right = glm::normalize(glm::cross(f, glm::dvec3(0.0, 1.0, 0.0)));
    return {right, glm::cross(right, f), f};
}

Axes axesOf(NamedView view) {
    switch (view) {
    case NamedView::back:
        return levelAxes({0, 0, 1});
    case NamedView::left:
        return levelAxes({1, 0, 0});
    case NamedView::right:
        return levelAxes({-1, 0, 0});
    case NamedView::top:
        return {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
    case NamedView::bottom:
        return {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
    case NamedView::threeQuarter:
        return levelAxes(kThreeQuarter);
    case NamedView::front:
    case NamedView::none:
        break;
    }
    return levelAxes({0, 0, -1});
}

// The nearest a camera may come with every point inside its field of view. Along one axis of the image, a
// point at `a` beside and `d` ahead lies inside if a - tan d <= c - tan e and a + tan d >= c + tan e, where
// the camera is at c and e.
class Fit {
  public:
    Fit(double tangent, const glm::dvec3& aside, const glm::dvec3& ahead)
        : tangent_(tangent), aside_(aside), ahead_(ahead) {}
    void add(const glm::dvec3& point) {
        const double a = glm::dot(point, aside_);
        const double d = tangent_ * glm::dot(point, ahead_);
        most_ = std::max(most_, a - d);
        least_ = std::min(least_, a + d);
    }
    // How far ahead the camera may be, in the middle between both borders; and there, how far aside it is.
    [[nodiscard]] double ahead() const { return (least_ - most_) / (2.0 * tangent_); }
    [[nodiscard]] double aside() const { return 0.5 * (least_ + most_); }

  private:
    double tangent_;
    glm::dvec3 aside_;
    glm::dvec3 ahead_;
    double most_ = -std::numeric_limits<double>::infinity();
    double least_ = std::numeric_limits<double>::infinity();
};

template <typename Visit>
void forEachVertex(const Scene& scene, const Visit& visit) {
    bool isEmpty = true;
    for (const Mesh& mesh : scene.meshes)
        for (const glm::vec3& position : mesh.positions) {
            visit(glm::dvec3(position));
            isEmpty = false;
        }
    if (isEmpty)
        visit(glm::dvec3(0.0));
}

Camera placed(const Axes& axes, const glm::dvec3& position, const ViewFrame& frame) {
    Camera camera;
    camera.position = glm::vec3(position);
    camera.right = glm::vec3(axes.right);
    camera.up = glm::vec3(axes.up);
    camera.forward = glm::vec3(axes.forward);
    camera.verticalFov = frame.verticalFov;
    return camera;
}

// Keeps a camera off a scene without extent.
double leastDistance(const Scene& scene) {
    const double radius = scene.bounds.radius();
    return radius > 0.0 ? 1e-3 * radius : 1.0;
}

} // namespace

Camera viewCamera(const Scene& scene, NamedView view, const ViewFrame& frame) {
    const Axes axes = axesOf(view);
    const double tangent = std::tan(0.5 * frame.verticalFov) / kViewMargin;
    Fit across(frame.aspect * tangent, axes.right, axes.forward);
    Fit upright(tangent, axes.up, axes.forward);
    double nearest = std::numeric_limits<double>::infinity();
    forEachVertex(scene, [&](const glm::dvec3& point) {
        across.add(point);
        upright.add(point);
        nearest = std::min(nearest, glm::dot(point, axes.forward));
    });
    const double ahead = std::min({across.ahead(), upright.ahead(), nearest - leastDistance(scene)});
    Camera camera =
        placed(axes, across.aside() * axes.right + upright.aside() * axes.up + ahead * axes.forward, frame);
    camera.name = "view";
    return camera;
}

Camera turnedCamera(const Scene& scene, NamedView view, float turns, const ViewFrame& frame) {
    const Axes still = axesOf(view);
    const glm::dvec3 middle(scene.bounds.center());
    const double tangent = std::tan(0.5 * frame.verticalFov) / kViewMargin;
    // A vertex sweeps a circle about the vertical. Of its points, those a cos + b sin beside or above the
    // middle and c sin ahead of it, the one that asks for the largest distance is found in closed form.
    const double level = std::hypot(still.forward.x, still.forward.z);
    const glm::dvec3 ahead = glm::dvec3(still.forward.x, 0.0, still.forward.z) / level;
    const double upAhead = glm::dot(still.up, ahead);
    const double across = std::hypot(1.0 / (frame.aspect * tangent), level);
    double distance = leastDistance(scene);
    forEachVertex(scene, [&](const glm::dvec3& point) {
        const glm::dvec3 offset = point - middle;
        const double radius = std::hypot(offset.x, offset.z);
        distance = std::max(distance, radius * across - offset.y * still.forward.y);
        for (const double end : {-radius, radius})
            distance = std::max(distance, std::abs(end * upAhead + offset.y * still.up.y) / tangent -
                                              end * level - offset.y * still.forward.y);
    });
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 2.0 * glm::pi<double>() * turns, glm::dvec3(0, 1, 0)));
    const Axes axes{turn * still.right, turn * still.up, turn * still.forward};
    Camera camera = placed(axes, middle - distance * axes.forward, frame);
    camera.name = "turntable";
    return camera;
}

Camera framingCamera(const Bounds& bounds) {
    const glm::dvec3 lower(bounds.lower);
    const glm::dvec3 upper(bounds.upper);
    const glm::dvec3 middle = 0.5 * (lower + upper);
    const glm::dvec3 size = upper - lower;
    const glm::dvec3 halfSize = glm::length(size) > 0.0 ? 0.5 * size : glm::dvec3(0.5);

    const glm::dvec3 forward = glm::normalize(kThreeQuarter);
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
