// Mouse and keys that move the camera.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <glm/glm.hpp>

#include "view/camera_rig.h"

namespace lavalight {

// What a user asks for with the mouse over the picture. Places are in screen coordinates.
struct ControlAnswer {
    bool hasMoved = false;            // the camera has moved
    bool isLetGo = false;             // a button that moved it was released
    bool isFlying = false;            // a key that moves the camera is held down
    std::optional<glm::vec2> inspect; // place that was clicked
    std::optional<glm::vec2> centre;  // place that was clicked twice
    std::optional<glm::vec2> focus;   // place that was clicked with F held down
};

// Reads what ImGui has of the input and leaves to the picture; `window` in screen coordinates. `isChord` is
// kept from call to call: letters that went down with Ctrl fly nowhere until they are up, even if Ctrl is up
// sooner.
[[nodiscard]] ControlAnswer moveCamera(CameraRig& rig, bool& isChord, const glm::vec2& window);

// Keys and what they do, for the help.
[[nodiscard]] std::span<const std::pair<std::string_view, std::string_view>> controlHelp();

} // namespace lavalight
