// What a user of the window looks at, and how.
#pragma once

#include <memory>
#include <string>

#include "gltf/import_options.h"
#include "render/settings.h"
#include "render/tone_settings.h"
#include "scene/scene.h"
#include "view/camera_rig.h"

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
    bool canBeHosted = false; // the device lets the host trace
    bool isFlying = false;    // keys or mouse move the camera
};

// Lets the cameras of a view stay where they are in the world, after `view.scene` has taken the place of a
// moment of another origin.
void moveOrigin(ViewState& view, const Scene& before);

} // namespace lavalight
