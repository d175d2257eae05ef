#include "view/controls.h"

#include <array>
#include <cmath>
#include <numbers>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace lavalight {
namespace {

// Points that a mouse may move between press and release of a click.
constexpr float kClickPoints = 3.0f;

// Share of the distance to the pivot that a notch of the wheel takes.
constexpr float kWheelStep = 0.1f;

// Dear ImGui has key numbers of its own since 1.87; 1.86 (Debian 12) takes GLFW's.
bool isDown(char letter) {
#if IMGUI_VERSION_NUM >= 18700
    return ImGui::IsKeyDown(static_cast<ImGuiKey>(ImGuiKey_A + (letter - 'A')));
#else
    return ImGui::IsKeyDown(GLFW_KEY_A + (letter - 'A'));
#endif
}

float pressed(char plus, char minus) {
    return (isDown(plus) ? 1.0f : 0.0f) - (isDown(minus) ? 1.0f : 0.0f);
}

glm::vec2 of(const ImVec2& v) {
    return {v.x, v.y};
}

void drag(CameraRig& rig, const glm::vec2& window, ControlAnswer& answer) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 delta = of(io.MouseDelta) / window.y;
    if (delta == glm::vec2(0.0f))
        return;
    const glm::vec2 turn = std::numbers::pi_v<float> * delta; // the window's height is half a turn
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClickPoints))
        io.KeyAlt ? rig.look({turn.x, -turn.y}) : rig.orbit({turn.x, -turn.y});
    else if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, kClickPoints) ||
             ImGui::IsMouseDragging(ImGuiMouseButton_Middle, kClickPoints))
        rig.pan(delta, window.x / window.y);
    else
        return;
    answer.hasMoved = true;
}

void fly(CameraRig& rig, bool& isChord, ControlAnswer& answer) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec3 way(pressed('D', 'A'), pressed('E', 'Q'), pressed('W', 'S'));
    isChord = way != glm::vec3(0.0f) && (isChord || io.KeyCtrl);
    answer.isFlying = way != glm::vec3(0.0f) && !isChord;
    if (!answer.isFlying)
        return;
    // As far as the pivot in a second. A window that was busy must not leap.
    const float seconds = std::min(io.DeltaTime, 0.1f) * (io.KeyShift ? 4.0f : 1.0f);
    rig.fly(way * (rig.distance() * seconds));
    answer.hasMoved = true;
}

void click(ControlAnswer& answer) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 at = of(io.MousePos);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        answer.centre = at;
        return;
    }
    // A drag that comes back to where it began is none.
    const float moved = io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left];
    if (!ImGui::IsMouseReleased(ImGuiMouseButton_Left) || moved > kClickPoints * kClickPoints)
        return;
    if (isDown('F'))
        answer.focus = at;
    else if (!io.MouseDownOwned[ImGuiMouseButton_Left])
        answer.inspect = at;
}

} // namespace

ControlAnswer moveCamera(CameraRig& rig, bool& isChord, const glm::vec2& window) {
    ControlAnswer answer;
    const ImGuiIO& io = ImGui::GetIO();
    if (!io.WantCaptureKeyboard)
        fly(rig, isChord, answer);
    if (io.WantCaptureMouse)
        return answer;
    drag(rig, window, answer);
    for (const ImGuiMouseButton button :
         {ImGuiMouseButton_Left, ImGuiMouseButton_Right, ImGuiMouseButton_Middle})
        answer.isLetGo |= ImGui::IsMouseReleased(button);
    if (io.MouseWheel != 0.0f) {
        rig.dolly(std::pow(1.0f - kWheelStep, io.MouseWheel));
        answer.hasMoved = true;
    }
    click(answer);
    return answer;
}

std::span<const std::pair<std::string_view, std::string_view>> controlHelp() {
    using Line = std::pair<std::string_view, std::string_view>;
    static constexpr std::array kLines{
        Line{"left drag", "orbit (with Alt: look around)"},
        Line{"right or middle drag", "pan"},
        Line{"wheel", "nearer, farther"},
        Line{"W A S D, Q E", "fly forward, left, back, right, down, up (with Shift: faster)"},
        Line{"double click", "orbit about this point"},
        Line{"click", "inspect this pixel and its paths; Escape ends it"},
        Line{"F and click", "focus here"},
        Line{"Home", "back to the scene's camera"},
        Line{"V", "the next view: colour, denoised, layers (with Shift: the one before)"},
        Line{"N", "without noise: the denoised picture, and back"},
        Line{"B", "two views or settings side by side; V and N are for the side of the mouse"},
        Line{"Ctrl+S", "save the image as EXR and PNG"},
        Line{"Tab", "hide and show the panel"},
        Line{"F1", "these keys"},
        Line{"Ctrl+Q", "quit"},
    };
    return kLines;
}

} // namespace lavalight
