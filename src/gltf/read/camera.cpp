// Cameras (glTF 2.0 specification, section 3.10): they look along -z of their node, y is up.
#include "gltf/read/camera.h"

#include <algorithm>
#include <cmath>

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

// False for a field of view that no image has.
bool setPerspective(const tinygltf::PerspectiveCamera& source, Camera& camera) {
    camera.projection = Projection::perspective;
    camera.verticalFov = static_cast<float>(source.yfov);
    if (source.aspectRatio > 0.0)
        camera.aspect = static_cast<float>(source.aspectRatio);
    return source.yfov > 0.0 && source.yfov < glm::pi<double>();
}

bool setOrthographic(const tinygltf::OrthographicCamera& source, Camera& camera) {
    camera.projection = Projection::orthographic;
    camera.halfHeight = static_cast<float>(std::abs(source.ymag));
    if (source.xmag != 0.0 && source.ymag != 0.0)
        camera.aspect = static_cast<float>(std::abs(source.xmag / source.ymag));
    return camera.halfHeight > 0.0f && std::isfinite(camera.halfHeight);
}

struct NumberedCamera {
    int number = 0;
    Camera camera;
};

} // namespace

std::vector<Camera> readCameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                                GltfNotes& notes) {
    std::vector<NumberedCamera> found;
    for (const PlacedNode& placed : nodes) {
        const tinygltf::Node& node = document.model.nodes[static_cast<size_t>(placed.node)];
        if (node.camera < 0)
            continue;
        const tinygltf::Camera& source = document.model.cameras[static_cast<size_t>(node.camera)];
        Camera camera;
        camera.name = printable(source.name.empty() ? node.name : source.name);
        const bool projects = source.type == "orthographic" ? setOrthographic(source.orthographic, camera)
                                                            : setPerspective(source.perspective, camera);
        if (projects && placeCamera(placed.toWorld, camera))
            found.push_back({node.camera, camera});
        else
            notes.addObject("cameras that cannot form an image were left out",
                            describe("camera", static_cast<size_t>(node.camera), camera.name));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const NumberedCamera& a, const NumberedCamera& b) { return a.number < b.number; });
    std::vector<Camera> cameras;
    for (const NumberedCamera& camera : found)
        cameras.push_back(camera.camera);
    return cameras;
}

} // namespace lavalight
