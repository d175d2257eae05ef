// What a user of the window looks at, and how.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "denoise/denoiser.h"
#include "gltf/import_options.h"
#include "render/settings.h"
#include "render/tone_settings.h"
#include "scene/scene.h"
#include "view/camera_rig.h"
#include "view/shown_layer.h"

namespace lavalight {

struct ViewState {
    std::string source; // built-in name or file
    ImportOptions import;
    std::shared_ptr<const Scene> scene;
    CameraRig rig;
    Camera home;             // camera that reset goes back to
    OptionPairs homeOptions; // options of `lavalight render` that place it
    RenderSettings settings;
    ToneSettings tone;
    bool isSplit = false;
    EstimatorSettings other{}; // settings of the image right of splitAt
    float splitAt = 0.5f;      // share of the window's width
    bool showsPanel = true;
    bool showsKeys = false;
    bool canBeHosted = false;          // the device lets the host trace
    bool isFlying = false;             // keys or mouse move the camera
    std::array<ShownLayer, 2> shown{}; // left and right of splitAt
    DenoiseQuality quality = DenoiseQuality::fast;
    std::string whyNotDenoised{}; // why nothing can be denoised; empty: it can
    uint32_t asked = 0;           // layers that were looked at: bit i for row i of FILM_PLANES
    bool exposesByImage = false;  // the image settles the exposure
    LightingSettings light{};     // light that is asked for; settings.lighting has that of `scene`
    GroundSettings ground{};      // ground that is asked for; settings.ground has that of `scene`
    std::string map{};            // environment map that was used last; empty: none
    glm::vec3 backdrop{1.0f};     // sRGB colour that is offered to stand behind the scene
};

// Shows the next picture of a side, or one so many steps on; another one beside it stays.
void stepShown(ViewState& view, size_t side, int steps);
// Shows the denoised colour of a side; the colour as it was rendered where that is shown.
void toggleDenoised(ViewState& view, size_t side);
// Lets the film have the planes of what is shown. Those that it has stay: to be without them would restart
// the image.
void askForPlanes(ViewState& view);

// Lets the cameras of a view stay where they are in the world, after `view.scene` has taken the place of a
// moment of another origin.
void moveOrigin(ViewState& view, const Scene& before);

} // namespace lavalight
