// Clipping planes of cameras (glTF 2.0, 3.10.3): triangles against the part of the view that a plane cuts
// off. Based on: Sutherland, Hodgman, "Reentrant Polygon Clipping", 1974.
#include "scene/clipping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lavalight {
namespace {

// A half space: dot(normal, p) <= limit, in the camera's own axes (right, up, forward).
struct HalfSpace {
    glm::dvec3 normal{0.0};
    double limit = 0.0;
};

// The sides of the view, and then two planes across it.
constexpr size_t kSides = 4;
using ViewPart = std::array<HalfSpace, kSides + 2>;

// The convex polygon that is left of a triangle; each half space adds a corner at most.
struct Polygon {
    std::array<glm::dvec3, 3 + kSides + 2> corners{};
    size_t count = 0;

    void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

// The part of the view between two distances along its direction. Rays from a lens start beside the middle.
ViewPart viewBetween(const Camera& camera, const ViewExtent& view, double nearest, double farthest) {
    const double lens = camera.lensRadius;
    const double slope = lens > 0.0 ? lens / camera.focusDistance : 0.0;
    const bool isPerspective = camera.projection == Projection::perspective;
    const auto side = [&](const glm::dvec3& outwards, double half) {
        return isPerspective ? HalfSpace{outwards - glm::dvec3(0.0, 0.0, half + slope), lens}
                             : HalfSpace{outwards, half};
    };
    const double right = view.middleRight;
    const double up = view.middleUp;
    return {{side({1.0, 0.0, 0.0}, view.halfWidth + right),
             side({-1.0, 0.0, 0.0}, view.halfWidth - right),
             side({0.0, 1.0, 0.0}, view.halfHeight + up),
             side({0.0, -1.0, 0.0}, view.halfHeight - up),
             {{0.0, 0.0, -1.0}, -nearest},
             {{0.0, 0.0, 1.0}, farthest}}};
}

Polygon cut(const Polygon& polygon, const HalfSpace& side) {
    Polygon rest;
    for (size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3& a = polygon.corners[i];
        const glm::dvec3& b = polygon.corners[(i + 1) % polygon.count];
        const double beyondA = glm::dot(side.normal, a) - side.limit;
        const double beyondB = glm::dot(side.normal, b) - side.limit;
        if (beyondA <= 0.0)
            rest.add(a);
        if ((beyondA < 0.0 && beyondB > 0.0) || (beyondA > 0.0 && beyondB < 0.0))
            rest.add(a + (b - a) * (beyondA / (beyondA - beyondB)));
    }
    return rest;
}

// Corners as the camera sees them: right, up, forward.
class ViewAxes {
  public:
    explicit ViewAxes(const Camera& camera)
        : position_(camera.position), right_(camera.right), up_(camera.up), forward_(camera.forward) {}

    [[nodiscard]] double forwardOf(const glm::vec3& p) const {
        return glm::dot(glm::dvec3(p) - position_, forward_);
    }
    [[nodiscard]] glm::dvec3 of(const glm::vec3& p) const {
        const glm::dvec3 d = glm::dvec3(p) - position_;
        return {glm::dot(d, right_), glm::dot(d, up_), glm::dot(d, forward_)};
    }

  private:
    glm::dvec3 position_;
    glm::dvec3 right_;
    glm::dvec3 up_;
    glm::dvec3 forward_;
};

// Counts triangles with something between two distances along the direction of view, up to `most`.
uint64_t trianglesBetween(const Scene& scene, const Camera& camera, const ViewExtent& view, double nearest,
                          double farthest, uint64_t most) {
    const ViewAxes axes(camera);
    const ViewPart part = viewBetween(camera, view, nearest, farthest);
    uint64_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const glm::uvec3& t : mesh.triangles) {
            const auto [least, greatest] =
                std::minmax({axes.forwardOf(mesh.positions[t.x]), axes.forwardOf(mesh.positions[t.y]),
                             axes.forwardOf(mesh.positions[t.z])});
            if (greatest < nearest || least > farthest)
                continue;
            Polygon polygon;
            for (int corner = 0; corner < 3; ++corner)
                polygon.add(axes.of(mesh.positions[t[corner]]));
            for (size_t i = 0; i < part.size() && polygon.count > 0; ++i)
                polygon = cut(polygon, part[i]);
            count += polygon.count > 0 ? 1 : 0;
            if (count >= most)
                return count;
        }
    return count;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool hasFarPlane(const Camera& camera) {
    return camera.projection != Projection::panorama && std::isfinite(camera.zfar);
}

} // namespace

ClipRange neededClipping(const Scene& scene, const Camera& camera, const ViewExtent& view) {
    if (camera.projection == Projection::panorama)
        return {};
    ClipRange range;
    const bool cutsNear =
        camera.znear > 0.0f && trianglesBetween(scene, camera, view, 0.0, camera.znear, 1) > 0;
    range.nearest = cutsNear ? camera.znear : 0.0f;
    if (hasFarPlane(camera) && trianglesBetween(scene, camera, view, camera.zfar, kInfinity, 1) > 0)
        range.depth = camera.zfar - range.nearest;
    return range;
}

uint64_t trianglesBeyondFar(const Scene& scene, const Camera& camera, const ViewExtent& view) {
    return hasFarPlane(camera) ? trianglesBetween(scene, camera, view, camera.zfar, kInfinity,
                                                  std::numeric_limits<uint64_t>::max())
                               : 0;
}

} // namespace lavalight
