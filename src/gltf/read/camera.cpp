// Cameras (glTF 2.0 specification, section 3.10): they look along -z of their node, y is up.
#include "gltf/read/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <glm/gtc/constants.hpp>

namespace lavalight {
namespace {

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Scales, shears and mirroring of the node are not the camera's: the direction of view stays, up is made
// perpendicular, right follows. False where the node squeezes these directions to nothing.
bool placeCamera(const glm::dmat4& toWorld, Camera& camera) {
    const glm::dvec3 forward = -glm::dvec3(toWorld[2]);
    const glm::dvec3 right = glm::cross(forward, glm::dvec3(toWorld[1]));
    if (!isFinite(forward) || !isFinite(right) || !isFinite(glm::dvec3(toWorld[3])) ||
        glm::length(right) == 0.0)
        return false;
    const glm::dvec3 unitForward = glm::normalize(forward);
    const glm::dvec3 unitRight = glm::normalize(right);
    camera.position = glm::vec3(toWorld[3]);
    camera.forward = glm::vec3(unitForward);
    camera.right = glm::vec3(unitRight);
    camera.up = glm::vec3(glm::cross(unitRight, unitForward));
    return isFinite(camera.position);
}

// Left alone where `aspect` is no ratio that a float holds.
void setAspect(double aspect, Camera& camera) {
    const auto ratio = static_cast<float>(aspect);
    if (!(ratio > 0.0f) || !std::isfinite(ratio))
        return;
    camera.aspect = ratio;
    camera.framedAspect = ratio;
}

// Infinite where the file names no far plane. Planes that would leave nothing to be seen are left out.
void setPlanes(JsonView source, const std::string& name, Camera& camera, GltfNotes& notes) {
    constexpr double kEndless = std::numeric_limits<float>::infinity();
    const auto nearest = static_cast<float>(source.number("znear", 0.0));
    const auto farthest = static_cast<float>(source.number("zfar", kEndless));
    if (!(nearest >= 0.0f && nearest < farthest)) {
        notes.addObject("clipping planes with nothing between them were left out", name);
        return;
    }
    camera.znear = nearest;
    camera.zfar = farthest;
}

// False for a field of view that no image has.
bool setPerspective(JsonView source, Camera& camera) {
    camera.projection = Projection::perspective;
    camera.verticalFov = static_cast<float>(source.number("yfov", 0.0));
    setAspect(source.number("aspectRatio", 0.0), camera);
    return camera.verticalFov > 0.0f && camera.verticalFov < glm::pi<double>();
}

bool setOrthographic(JsonView source, Camera& camera) {
    const double xmag = source.number("xmag", 0.0);
    const double ymag = source.number("ymag", 0.0);
    camera.projection = Projection::orthographic;
    camera.halfHeight = static_cast<float>(std::abs(ymag));
    setAspect(std::abs(xmag / ymag), camera);
    return camera.halfHeight > 0.0f && std::isfinite(camera.halfHeight);
}

} // namespace

std::vector<PlacedCamera> readCameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                                      GltfNotes& notes) {
    std::vector<PlacedCamera> found;
    for (const PlacedNode& placed : nodes) {
        const JsonView node = document.list("nodes")[placed.node];
        const std::optional<size_t> number = node.index("camera");
        if (!number)
            continue;
        const JsonView source = document.list("cameras")[*number];
        const std::string& ownName = source.text("name");
        Camera camera;
        camera.name = printable(ownName.empty() ? node.text("name") : ownName);
        const bool projects = source.text("type") == "orthographic"
                                  ? setOrthographic(source["orthographic"], camera)
                                  : setPerspective(source["perspective"], camera);
        const std::string name = describe("camera", *number, camera.name);
        if (projects && placeCamera(placed.toWorld, camera)) {
            setPlanes(source[source.text("type")], name, camera, notes);
            found.push_back({*number, glm::dvec3(placed.toWorld[3]), camera});
        } else {
            notes.addObject("cameras that cannot form an image were left out", name);
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const PlacedCamera& a, const PlacedCamera& b) { return a.number < b.number; });
    return found;
}

} // namespace lavalight
