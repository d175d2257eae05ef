#include "view/scene_panel.h"

#include <algorithm>
#include <array>

#include "base/named.h"
#include "view/light_choice.h"
#include "view/widgets.h"

namespace lavalight {
namespace {

// sRGB signals from 0 to 1 of 0xrrggbb, and back.
glm::vec3 signalsOf(uint32_t color) {
    return glm::vec3(color >> 16, color >> 8 & 0xffu, color & 0xffu) / 255.0f;
}

uint32_t hexOf(const glm::vec3& signals) {
    const glm::uvec3 bytes(glm::round(255.0f * glm::clamp(signals, 0.0f, 1.0f)));
    return bytes.x << 16 | bytes.y << 8 | bytes.z;
}

// True where the scene has to be read again: what is far from its origin is too coarse to be looked at from
// near by.
bool drawCameras(ViewState& view) {
    bool isElsewhere = false;
    const std::vector<Camera>& cameras = view.scene->cameras;
    std::vector<std::string> names;
    for (const Camera& camera : cameras)
        names.push_back(camera.name);
    const auto home = std::find(cameras.begin(), cameras.end(), view.home);
    const std::string shown = home == cameras.end()
                                  ? view.home.name
                                  : nameOrNumber(names, static_cast<size_t>(home - cameras.begin()));
    if (ImGui::BeginCombo("camera", shown.c_str())) {
        for (size_t i = 0; i < cameras.size(); ++i)
            if (offer(i, nameOrNumber(names, i), cameras[i] == view.home)) {
                view.home = cameras[i];
                view.homeOptions = i == 0 ? OptionPairs() : OptionPairs{{"camera", textFor(names, i)}};
                view.rig = CameraRig(cameras[i], view.scene->bounds);
                view.import.viewpoint.reset();
                view.import.camera = textFor(names, i);
                isElsewhere = view.scene->coarse.has_value();
            }
        ImGui::EndCombo();
    }
    explain("The scene's cameras; moving starts from the chosen one (Home goes back to it)");
    return isElsewhere;
}

void drawLens(ViewState& view) {
    const Camera& camera = view.rig.camera();
    if (camera.projection != Projection::perspective)
        return;
    float degrees = glm::degrees(camera.verticalFov);
    if (ImGui::SliderFloat("field of view", &degrees, 5.0f, 150.0f, "%.0f deg", ImGuiSliderFlags_AlwaysClamp))
        view.rig.setVerticalFov(glm::radians(degrees));
    explain("The angle between the image's upper and lower edge");
    const float most = 0.2f * view.rig.distance();
    float aperture = 2.0f * camera.lensRadius;
    if (ImGui::SliderFloat("aperture", &aperture, 0.0f, std::max(most, aperture), "%.4f m",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
        view.rig.setLens(0.5f * aperture);
    explain("Diameter of the lens: what is out of focus is blurred by it. 0: a pinhole. F and a click focus");
    if (camera.lensRadius > 0.0f) {
        float focus = camera.focusDistance;
        if (ImGui::DragFloat("focus", &focus, 0.01f * view.rig.distance(), 1e-4f, 1e9f, "%.3f m",
                             ImGuiSliderFlags_AlwaysClamp))
            view.rig.setFocusDistance(focus);
        explain("Distance of what is sharp");
    }
}

void drawSky(SkySettings& sky) {
    ImGui::SliderFloat("sun's elevation", &sky.sunElevation, 0.0f, 90.0f, "%.0f deg",
                       ImGuiSliderFlags_AlwaysClamp);
    explain("Degrees of the sun above the horizon");
    ImGui::SliderFloat("sun's azimuth", &sky.sunAzimuth, -180.0f, 180.0f, "%.0f deg",
                       ImGuiSliderFlags_AlwaysClamp);
    explain("Degrees of the sun from +Z, the front of a model, towards +X");
    ImGui::SliderFloat("turbidity", &sky.turbidity, 1.0f, 10.0f, "%.1f", ImGuiSliderFlags_AlwaysClamp);
    explain("From 1, clear air, to 10, haze");
}

// True where another light is to be brought.
bool drawLight(ViewState& view) {
    const LightingSettings before = view.light;
    if (!view.light.mapFile.empty())
        view.map = view.light.mapFile;
    const std::vector<LightOffer> offers = lightOffers(view.light, view.map);
    const auto now = std::find_if(offers.begin(), offers.end(), [&](const LightOffer& offer) {
        return isSameLight(offer.lighting, view.light);
    });
    if (ImGui::BeginCombo("light", now == offers.end() ? "" : now->name.c_str())) {
        for (size_t i = 0; i < offers.size(); ++i)
            if (offer(i, offers[i].name, isSameLight(offers[i].lighting, view.light)))
                view.light = offers[i].lighting;
        ImGui::EndCombo();
    }
    explain(
        "What shines where nothing is hit. A file without light of its own has the studio. Drop a .hdr or "
        ".exr file here for a map");
    if (view.light.procedural == ProceduralEnvironment::sky)
        drawSky(view.light.sky);
    return !isSameLight(view.light, before);
}

bool drawEnvironment(ViewState& view) {
    RenderSettings& settings = view.settings;
    const bool isOther = drawLight(view);
    if (view.scene->environmentMap) {
        ImGui::SliderFloat("map's rotation", &settings.lighting.rotation, -180.0f, 180.0f, "%.0f deg");
        explain("Turns the environment map about the vertical");
    }
    ImGui::DragFloat("environment", &settings.lighting.intensity, 0.01f, 0.0f, 1000.0f, "times %.2f",
                     ImGuiSliderFlags_AlwaysClamp);
    explain("Multiplies what shines where nothing is hit");
    return isOther;
}

// The colour of a new ground.
constexpr uint32_t kGroundColor = 0x808080;

bool drawGround(ViewState& view) {
    static constexpr std::array<SettingName<Ground>, 3> kNames{
        {{"nothing", Ground::none}, {"a matt surface", Ground::lambert}, {"a shadow", Ground::shadow}}};
    const GroundSettings before = view.ground;
    if (chooseAmong<Ground>(
            "ground", kNames, view.ground.kind,
            "What lies right below the scene: nothing, a matt surface, or a plane that catches "
            "shadows and shows the background"))
        view.ground.color = view.ground.kind == Ground::lambert ? kGroundColor : 0;
    if (view.ground.kind == Ground::lambert) {
        glm::vec3 color = signalsOf(view.ground.color);
        ImGui::ColorEdit3("##ground", &color.x, ImGuiColorEditFlags_DisplayHex);
        view.ground.color = hexOf(color);
    }
    return view.ground != before;
}

bool drawVariants(ViewState& view) {
    if (view.scene->variants.empty())
        return false;
    bool isChanged = false;
    const char* none = "as the file has it";
    if (ImGui::BeginCombo("variant", view.import.variant.empty() ? none : view.import.variant.c_str())) {
        const std::string before = view.import.variant;
        if (offer(0, none, before.empty()))
            view.import.variant.clear();
        const std::vector<std::string>& variants = view.scene->variants;
        for (size_t i = 0; i < variants.size(); ++i)
            if (offer(i + 1, nameOrNumber(variants, i), textFor(variants, i) == before))
                view.import.variant = textFor(variants, i);
        isChanged = view.import.variant != before;
        ImGui::EndCombo();
    }
    explain("Sets of materials that the file offers");
    return isChanged;
}

bool drawMoment(ViewState& view) {
    if (view.scene->animations.empty())
        return false;
    float seconds = static_cast<float>(view.import.seconds.value_or(0.0));
    float last = 0.0f;
    for (const Animation& animation : view.scene->animations)
        last = std::max(last, animation.seconds);
    const bool isMoved =
        ImGui::SliderFloat("moment", &seconds, 0.0f, last, "%.2f s", ImGuiSliderFlags_AlwaysClamp);
    explain("The time of the scene's animation");
    if (isMoved)
        view.import.seconds = seconds;
    return isMoved;
}

} // namespace

bool drawScene(ViewState& view) {
    const bool isElsewhere = drawCameras(view);
    drawLens(view);
    const bool hasLight = drawEnvironment(view);
    const bool hasGround = drawGround(view);
    const bool hasVariant = drawVariants(view);
    return drawMoment(view) || hasVariant || hasGround || hasLight || isElsewhere;
}

} // namespace lavalight
