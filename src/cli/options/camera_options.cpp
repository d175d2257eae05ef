#include "cli/options/camera_options.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/named.h"
#include "cli/options/option_values.h"
#include "scene/look_at.h"

namespace lavalight {
namespace {

const Camera& pickCamera(const Scene& scene, const std::string& wanted) {
    if (wanted.empty())
        return scene.cameras.front();
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras)
        names.push_back(camera.name);
    return scene.cameras[findNamed(names, {wanted, "--camera", "camera", scene.source})];
}

glm::vec3 vectorOf(const char* option, const std::string& text) {
    const std::optional<glm::vec3> vector = parseVector(text);
    if (!vector)
        throw UsageError(fmt::format("{}: \"{}\" is not X,Y,Z", option, text));
    return *vector;
}

} // namespace

CameraOptions::CameraOptions(CLI::App& parser) : parser_(&parser) {
    parser.add_option("--camera", name_, "Camera by name or index; default: the first")
        ->type_name("NAME|INDEX");
    parser.add_option("--look-from", from_, "A camera at this place; with --look-at, instead of the scene's")
        ->type_name("X,Y,Z");
    parser.add_option("--look-at", at_, "The point in the middle of the image")->type_name("X,Y,Z");
    parser.add_option("--up", up_, "What is up for --look-from; default: 0,1,0")->type_name("X,Y,Z");
    parser.add_option("--fov", fov_, "Vertical field of view, above 0 and below 180")->type_name("DEGREES");
    parser.add_option("--aperture", aperture_, "Diameter of the lens; 0: all is sharp")->type_name("METRES");
    parser
        .add_option("--focus", focus_,
                    "Distance to the plane that is sharp, along the view; default: to --look-at, else to the "
                    "middle of the scene")
        ->type_name("METRES");
    parser.add_flag("--panorama", panorama_,
                    "All directions around the camera, laid out as environment maps are");
}

void CameraOptions::aim(Camera& camera) const {
    if (!isGiven("--look-from") && !isGiven("--look-at") && !isGiven("--up"))
        return;
    if (!isGiven("--look-from") || (!isGiven("--look-at") && !panorama_))
        throw UsageError("--look-from and --look-at: one needs the other");
    if (isGiven("--camera"))
        throw UsageError("--camera and --look-from: one camera is enough");
    const glm::vec3 from = vectorOf("--look-from", from_);
    const glm::vec3 at =
        isGiven("--look-at") ? vectorOf("--look-at", at_) : from + glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 up = isGiven("--up") ? vectorOf("--up", up_) : glm::vec3(0.0f, 1.0f, 0.0f);
    const std::optional<Camera> aimed = lookAtCamera(from, at, up);
    if (!aimed)
        throw UsageError(from == at ? fmt::format("--look-at: {} is where the camera is", at_)
                                    : "--up: it must not be 0,0,0 or lie along the direction of view");
    camera = *aimed;
    camera.focusDistance = glm::dot(at - from, camera.forward);
}

void CameraOptions::setLens(const Scene& scene, Camera& camera) const {
    if (!(aperture_ >= 0.0f) || !std::isfinite(aperture_))
        throw UsageError(fmt::format("--aperture: {} is no diameter of 0 or more metres", aperture_));
    if (isGiven("--focus") && (!(focus_ > 0.0f) || !std::isfinite(focus_)))
        throw UsageError(fmt::format("--focus: {} is no distance above 0 metres", focus_));
    if (aperture_ == 0.0f)
        return;
    if (camera.projection != Projection::perspective)
        throw UsageError("--aperture: only perspective cameras have a lens");
    camera.lensRadius = 0.5f * aperture_;
    if (isGiven("--focus"))
        camera.focusDistance = focus_;
    else if (!isGiven("--look-at"))
        camera.focusDistance = glm::dot(scene.bounds.center() - camera.position, camera.forward);
    if (!(camera.focusDistance > 0.0f))
        throw UsageError("--focus: the middle of the scene is behind the camera; give a distance");
}

OptionPairs CameraOptions::given() const {
    OptionPairs pairs;
    for (const char* name : {"look-from", "look-at", "up", "fov", "aperture", "focus", "panorama"})
        if (const std::string option = fmt::format("--{}", name); isGiven(option.c_str()))
            pairs.emplace_back(name, panorama_ && option == "--panorama"
                                         ? "on"
                                         : parser_->get_option(option)->as<std::string>());
    return pairs;
}

Camera CameraOptions::cameraOf(const Scene& scene) const {
    Camera camera = pickCamera(scene, name_);
    aim(camera);
    if (isGiven("--fov")) {
        if (!(fov_ > 0.0f && fov_ < 180.0f))
            throw UsageError(
                fmt::format("--fov: {} is outside the range above 0 to below 180 degrees", fov_));
        if (panorama_ || camera.projection != Projection::perspective)
            throw UsageError("--fov: only perspective cameras have one");
        camera.verticalFov = static_cast<float>(double{fov_} * std::numbers::pi / 180.0);
    }
    if (panorama_) {
        camera.projection = Projection::panorama;
        camera.aspect = 2.0f;
    }
    setLens(scene, camera);
    return camera;
}

} // namespace lavalight
