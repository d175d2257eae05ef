#include "view/screen_panel.h"

#include <array>
#include <cmath>

#include "image/srgb.h"
#include "session/denoise_names.h"
#include "view/widgets.h"

namespace lavalight {
namespace {

const ImVec4 kGreyed(0.5f, 0.5f, 0.5f, 1.0f);

void drawShown(const char* label, ViewState& view, ShownLayer& shown) {
    if (ImGui::BeginCombo(label, nameOf(shown).c_str())) {
        for (const ShownLayer& layer : shownLayers()) {
            const bool isBarred = layer.isDenoised && !view.whyNotDenoised.empty();
            const ImGuiSelectableFlags flags =
                isBarred ? ImGuiSelectableFlags_Disabled : ImGuiSelectableFlags_None;
            if (ImGui::Selectable(nameOf(layer).c_str(), layer == shown, flags))
                shown = layer;
        }
        ImGui::EndCombo();
    }
    explain("The colour, that denoised, or a layer of the first surface. A layer that the image lacks "
            "restarts it");
}

void drawDenoising(ViewState& view) {
    if (!view.whyNotDenoised.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(kGreyed, "%s", view.whyNotDenoised.c_str());
        ImGui::PopTextWrapPos();
    } else if (view.shown[0].isDenoised || (view.isSplit && view.shown[1].isDenoised)) {
        choose(
            "denoiser", view.quality,
            "How well Open Image Denoise does it: fast follows the camera, high denoises albedo and normals "
            "first");
    }
}

enum class Behind { environment, transparent, color, radiance };

Behind behindOf(const ViewState& view) {
    if (view.settings.background.kind == Background::constant)
        return Behind::radiance;
    if (view.settings.background.kind == Background::environment)
        return Behind::environment;
    return view.tone.backdrop ? Behind::color : Behind::transparent;
}

// In the steps of #rrggbb.
glm::vec3 linearOf(glm::vec3& color) {
    glm::vec3 linear(0.0f);
    for (glm::length_t c = 0; c < 3; ++c) {
        color[c] = std::round(255.0f * color[c]) / 255.0f;
        linear[c] = static_cast<float>(decodeSrgb(color[c]));
    }
    return linear;
}

void drawBackground(ViewState& view) {
    static constexpr std::array<SettingName<Behind>, 4> kNames{{{"environment", Behind::environment},
                                                                {"transparent", Behind::transparent},
                                                                {"a colour", Behind::color},
                                                                {"a radiance", Behind::radiance}}};
    Behind behind = behindOf(view);
    if (chooseAmong<Behind>(
            "background", kNames, behind,
            "What is seen behind the scene: the environment, nothing (shown as a chequered "
            "ground), a colour of the screen, or a radiance that goes through the tone curve")) {
        view.settings.background.kind = behind == Behind::environment ? Background::environment
                                        : behind == Behind::radiance  ? Background::constant
                                                                      : Background::transparent;
        view.settings.background.radiance = behind == Behind::radiance ? glm::vec3(0.18f) : glm::vec3(0.0f);
    }
    if (behind == Behind::color) {
        ImGui::ColorEdit3("##backdrop", &view.backdrop.x, ImGuiColorEditFlags_DisplayHex);
        view.tone.backdrop = linearOf(view.backdrop);
    } else {
        view.tone.backdrop.reset();
    }
    if (behind == Behind::radiance)
        ImGui::DragFloat3("##radiance", &view.settings.background.radiance.x, 0.01f, 0.0f, 1000.0f, "%.2f",
                          ImGuiSliderFlags_AlwaysClamp);
}

void drawTone(ViewState& view, float exposure) {
    choose("tone mapping", view.tone.curve,
           "How radiance becomes a screen's colour: cut off at 1, or with a shoulder (Khronos PBR Neutral, "
           "AgX, ACES). The EXR is not touched");
    if (tick("exposure by the image", view.exposesByImage,
             "The log-average luminance becomes middle grey, as --exposure auto has it") &&
        !view.exposesByImage)
        view.tone.exposure = exposure; // from where it was
    if (view.exposesByImage) {
        ImGui::Text("%.1f stops", static_cast<double>(exposure));
    } else {
        ImGui::SliderFloat("exposure", &view.tone.exposure, -10.0f, 10.0f, "%.1f stops");
        explain("Each stop doubles the brightness shown. The EXR is not touched");
    }
}

} // namespace

void drawScreen(ViewState& view, float exposure) {
    drawShown(view.isSplit ? "left" : "picture", view, view.shown[0]);
    if (view.isSplit)
        drawShown("right", view, view.shown[1]);
    tick("side by side", view.isSplit,
         "Two views beside each other, of one image or of two that are rendered for the same time: the right "
         "one has an estimator of its own");
    drawDenoising(view);
    drawBackground(view);
    drawTone(view, exposure);
}

} // namespace lavalight
