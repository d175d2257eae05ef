#include "scene/starting_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/solids.h"

namespace lavalight {
namespace {

// Places within the rectangle that rays start in, for where its middle lies on a surface.
constexpr std::array<glm::dvec2, 3> kOtherPlaces{{{0.41, 0.37}, {0.62, 0.71}, {0.23, 0.58}}};

// The corners of the rectangle that rays start in.
using Corners = std::array<glm::dvec3, 4>;

Corners startsOf(const Camera& camera, const ViewExtent& view, double nearest) {
    const double lens = camera.lensRadius * std::abs(1.0 - nearest / camera.focusDistance);
    double halfWidth = 0.0;
    double halfHeight = 0.0;
    if (camera.projection == Projection::orthographic) {
        halfWidth = view.halfWidth;
        halfHeight = view.halfHeight;
    } else if (camera.projection == Projection::perspective) {
        halfWidth = nearest * view.halfWidth + lens;
        halfHeight = nearest * view.halfHeight + lens;
    }
    if (camera.projection == Projection::panorama)
        nearest = 0.0;
    const glm::dvec3 aside =
        double{view.middleRight} * glm::dvec3(camera.right) + double{view.middleUp} * glm::dvec3(camera.up);
    const glm::dvec3 middle = glm::dvec3(camera.position) + nearest * (glm::dvec3(camera.forward) + aside);
    const glm::dvec3 right = halfWidth * glm::dvec3(camera.right);
    const glm::dvec3 up = halfHeight * glm::dvec3(camera.up);
    return {middle - right - up, middle + right - up, middle + right + up, middle - right + up};
}

// Whether a triangle may cross the rectangle: no, if the box or the plane of one leaves the other on one
// side.
bool mayCross(const Corners& corners, const std::array<glm::dvec3, 3>& triangle) {
    const glm::dvec3 lower = glm::min(glm::min(corners[0], corners[1]), glm::min(corners[2], corners[3]));
    const glm::dvec3 upper = glm::max(glm::max(corners[0], corners[1]), glm::max(corners[2], corners[3]));
    const glm::dvec3 least = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
    const glm::dvec3 most = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
    if (glm::any(glm::lessThan(upper, least)) || glm::any(glm::greaterThan(lower, most)))
        return false;
    const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const auto isBefore = [&](const glm::dvec3& p) { return glm::dot(normal, p - triangle[0]) < 0.0; };
    const auto isBehind = [&](const glm::dvec3& p) { return glm::dot(normal, p - triangle[0]) > 0.0; };
    return std::none_of(corners.begin(), corners.end(), isBefore) ==
           std::none_of(corners.begin(), corners.end(), isBehind);
}

bool anyCrosses(const Scene& scene, const Corners& corners) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
        return mesh.solid != 0 &&
               std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
                   return mayCross(corners, {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
               });
    });
}

} // namespace

StartingSolids startingSolids(const Scene& scene, const Camera& camera, const ViewExtent& view,
                              float nearest) {
    const Corners corners = startsOf(camera, view, nearest);
    StartingSolids starting;
    starting.reference = 0.5 * (corners[0] + corners[2]);
    if (scene.solids.empty())
        return starting;
    SolidsAround around = solidsAround(scene, starting.reference);
    for (size_t i = 0; i < kOtherPlaces.size() && around.isOnSurface; ++i) {
        starting.reference = corners[0] + kOtherPlaces[i].x * (corners[1] - corners[0]) +
                             kOtherPlaces[i].y * (corners[3] - corners[0]);
        around = solidsAround(scene, starting.reference);
    }
    starting.around = std::move(around.numbers);
    starting.vary = corners[0] != corners[2] && anyCrosses(scene, corners);
    return starting;
}

} // namespace lavalight
