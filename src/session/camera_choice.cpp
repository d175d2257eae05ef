#include "session/camera_choice.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/named.h"
#include "base/option_text.h"
#include "render/setting_names.h"
#include "scene/look_at.h"
#include "scene/world_position.h"

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

void aim(Camera& camera, const Scene& scene, const CameraChoice& choice) {
    if (!choice.lookFrom && !choice.lookAt && !choice.up)
        return;
    if (!choice.lookFrom || (!choice.lookAt && !choice.panorama))
        throw UsageError("--look-from and --look-at: one needs the other");
    if (!choice.name.empty())
        throw UsageError("--camera and --look-from: one camera is enough");
    const glm::vec3 from = fromWorld(*choice.lookFrom, scene.origin);
    const glm::vec3 at =
        choice.lookAt ? fromWorld(*choice.lookAt, scene.origin) : from + glm::vec3(1.0f, 0.0f, 0.0f);
    const std::optional<Camera> aimed =
        lookAtCamera(from, at, choice.up.value_or(glm::vec3(0.0f, 1.0f, 0.0f)));
    if (!aimed)
        throw UsageError(
            from == at ? fmt::format("--look-at: {} is where the camera is", commaText(*choice.lookFrom))
                       : "--up: it must not be 0,0,0 or lie along the direction of view");
    camera = *aimed;
    camera.focusDistance = glm::dot(at - from, camera.forward);
}

Camera frameView(const Scene& scene, const CameraChoice& choice, float aspect) {
    if (!choice.name.empty() || choice.lookFrom || choice.lookAt || choice.up || choice.panorama)
        throw UsageError("--view and --turntable frame the scene with a camera of their own; give them "
                         "without --camera, --look-from, --look-at, --up and --panorama");
    const bool isVertical = choice.view == NamedView::top || choice.view == NamedView::bottom;
    if (choice.intrinsics)
        throw UsageError(
            "--intrinsics: --view and --turntable frame the scene by a field of view; try --fov");
    if (choice.turns && isVertical)
        throw UsageError(
            "--turntable turns about the vertical; give a --view that is not from above or below");
    ViewFrame frame{.aspect = aspect};
    if (choice.fov && *choice.fov > 0.0f && *choice.fov < 180.0f)
        frame.verticalFov = glm::radians(*choice.fov);
    return choice.turns ? turnedCamera(scene, choice.view, *choice.turns, frame)
                        : viewCamera(scene, choice.view, frame);
}

void setFieldOfView(Camera& camera, const CameraChoice& choice) {
    if (!choice.fov)
        return;
    if (!(*choice.fov > 0.0f && *choice.fov < 180.0f))
        throw UsageError(
            fmt::format("--fov: {} is outside the range above 0 to below 180 degrees", *choice.fov));
    if (choice.panorama || camera.projection != Projection::perspective)
        throw UsageError("--fov: only perspective cameras have one");
    camera.framedAspect = 0.0f; // this height, whatever the image's width
    camera.verticalFov = static_cast<float>(double{*choice.fov} * std::numbers::pi / 180.0);
}

void setIntrinsics(Camera& camera, const CameraChoice& choice) {
    if (!choice.intrinsics)
        return;
    if (choice.fov)
        throw UsageError("--fov and --intrinsics: one is enough");
    if (choice.panorama || camera.projection != Projection::perspective)
        throw UsageError("--intrinsics: only perspective cameras have them");
    for (const glm::length_t axis : {0, 1}) {
        requireRange("--intrinsics (focal length in pixels)", choice.intrinsics->focal[axis], 1e-3, 1e9);
        requireRange("--intrinsics (principal point in pixels)", choice.intrinsics->center[axis], -1e6, 1e6);
    }
    camera.intrinsics = choice.intrinsics;
}

void setPlanes(Camera& camera, const CameraChoice& choice) {
    if (choice.clip && choice.seesAll)
        throw UsageError("--clip and --no-clip: one is enough");
    if (choice.clip && !(choice.clip->x >= 0.0f && choice.clip->x < choice.clip->y))
        throw UsageError(
            fmt::format("--clip: {},{} leaves nothing to be seen; give two distances, the nearer "
                        "one first",
                        choice.clip->x, choice.clip->y));
    if (choice.clip || choice.seesAll) {
        camera.znear = choice.clip ? choice.clip->x : Camera{}.znear;
        camera.zfar = choice.clip ? choice.clip->y : Camera{}.zfar;
    }
}

void setLens(Camera& camera, const Scene& scene, const CameraChoice& choice) {
    if (!(choice.aperture >= 0.0f) || !std::isfinite(choice.aperture))
        throw UsageError(
            fmt::format("--aperture: {} is not a diameter of 0 or more metres", choice.aperture));
    if (choice.focus && (!(*choice.focus > 0.0f) || !std::isfinite(*choice.focus)))
        throw UsageError(fmt::format("--focus: {} is not a distance above 0 metres", *choice.focus));
    if (choice.aperture == 0.0f)
        return;
    if (camera.projection != Projection::perspective)
        throw UsageError("--aperture: only perspective cameras have a lens");
    camera.lensRadius = 0.5f * choice.aperture;
    if (choice.focus)
        camera.focusDistance = *choice.focus;
    else if (!choice.lookAt)
        camera.focusDistance = glm::dot(scene.bounds.center() - camera.position, camera.forward);
    if (!(camera.focusDistance > 0.0f))
        throw UsageError("--focus: the middle of the scene is behind the camera; give a distance");
}

} // namespace

ImportOptions seenFrom(const CameraChoice& choice, ImportOptions options) {
    options.viewpoint = choice.lookFrom;
    options.camera = choice.name;
    return options;
}

Camera chooseCamera(const Scene& scene, const CameraChoice& choice, float aspect) {
    Camera camera =
        choice.view == NamedView::none ? pickCamera(scene, choice.name) : frameView(scene, choice, aspect);
    aim(camera, scene, choice);
    setFieldOfView(camera, choice);
    setIntrinsics(camera, choice);
    if (choice.panorama) {
        camera.projection = Projection::panorama;
        camera.aspect = 2.0f;
    }
    setPlanes(camera, choice);
    setLens(camera, scene, choice);
    return camera;
}

OptionPairs describe(const CameraChoice& choice) {
    OptionPairs pairs;
    const auto add = [&](const char* name, const std::optional<std::string>& text) {
        if (text)
            pairs.emplace_back(name, *text);
    };
    const auto number = [](const std::optional<float>& value) {
        return value ? std::optional(fmt::format("{}", *value)) : std::nullopt;
    };
    const auto vector = [](const auto& value) {
        return value ? std::optional(commaText(*value)) : std::nullopt;
    };
    add("look-from", vector(choice.lookFrom));
    add("look-at", vector(choice.lookAt));
    add("up", vector(choice.up));
    add("fov", number(choice.fov));
    if (const auto& intrinsics = choice.intrinsics)
        add("intrinsics", fmt::format("{},{},{},{}", intrinsics->focal.x, intrinsics->focal.y,
                                      intrinsics->center.x, intrinsics->center.y));
    if (choice.view != NamedView::none)
        add("view", std::string(nameOf(choice.view)));
    add("turns", number(choice.turns));
    add("aperture", choice.aperture > 0.0f ? number(choice.aperture) : std::nullopt);
    add("focus", number(choice.focus));
    add("panorama", choice.panorama ? std::optional<std::string>("on") : std::nullopt);
    add("clip",
        choice.clip ? std::optional(fmt::format("{},{}", choice.clip->x, choice.clip->y)) : std::nullopt);
    add("no-clip", choice.seesAll ? std::optional<std::string>("on") : std::nullopt);
    return pairs;
}

} // namespace lavalight
