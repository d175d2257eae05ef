// Which camera a render looks through: one of the scene's, or one that is placed by hand.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "gltf/import_options.h"
#include "render/settings.h"
#include "scene/framing_camera.h"
#include "scene/scene.h"

namespace lavalight {

// Lengths in metres, places in the world of the file. Members have the names of the command line's options.
struct CameraChoice {
    std::string name;                     // a camera of the scene by name or index; empty: the first
    std::optional<glm::dvec3> lookFrom;   // a camera at this place; with lookAt, instead of the scene's
    std::optional<glm::dvec3> lookAt;     // the point in the middle of the image
    std::optional<glm::vec3> up;          // default: +Y
    std::optional<float> fov;             // vertical, in degrees, above 0 and below 180
    std::optional<Intrinsics> intrinsics; // instead of a field of view
    float aperture = 0.0f;                // diameter of the lens; 0: all is sharp
    std::optional<float> focus;           // to the plane that is sharp, along the view
    NamedView view = NamedView::none;     // frames the scene from there, instead of a camera of its own
    std::optional<float> turns;           // of that view about the scene's vertical: a frame of a turntable
    bool panorama = false;                // all directions, laid out as environment maps are
    std::optional<glm::vec2> clip;        // nearest and farthest that is seen, instead of the camera's
    bool seesAll = false;                 // without the planes of the scene's camera
    bool operator==(const CameraChoice&) const = default;
};

// Import options for a scene that is seen so: its coordinates are finest there.
[[nodiscard]] ImportOptions seenFrom(const CameraChoice& choice, ImportOptions options);

// `aspect`: width over height of the image, for a view that frames the scene. Throws UsageError naming the
// option and what it takes, or the cameras there are.
[[nodiscard]] Camera chooseCamera(const Scene& scene, const CameraChoice& choice, float aspect = 1.0f);

// Names (without dashes) and values of what the camera's name does not tell.
[[nodiscard]] OptionPairs describe(const CameraChoice& choice);

} // namespace lavalight
