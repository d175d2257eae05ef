#include "view/estimator_panel.h"

#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include "render/presets.h"
#include "render/setting_rules.h"
#include "render/setting_table.h"
#include "view/widgets.h"

namespace lavalight {
namespace {

bool drawPresets(EstimatorSettings& settings) {
    bool isChanged = false;
    if (ImGui::BeginCombo("preset", "a step of the lecture")) {
        for (const Preset& preset : presets()) {
            if (ImGui::Selectable(std::string(preset.name).c_str())) {
                const uint32_t seed = settings.seed;
                settings = preset.settings;
                settings.seed = seed;
                isChanged = true;
            }
            explain(std::string(preset.meaning).c_str());
        }
        ImGui::EndCombo();
    }
    explain("All settings at once, as one step of the lecture has them");
    return isChanged;
}

// Draws a setting by the kind of its values. Whether it was changed.
struct DrawSetting {
    EstimatorSettings& settings;
    std::string label;
    std::string help;

    bool operator()(const NamedValues& values) const {
        uint32_t value = values.get(settings);
        bool isChanged = false;
        if (values.isSwitch) {
            bool isOn = value != 0;
            isChanged = tick(label.c_str(), isOn, help.c_str());
            value = isOn ? 1 : 0;
        } else {
            isChanged = chooseAmong(label.c_str(), values.names, value, help.c_str());
        }
        if (isChanged)
            values.set(settings, value);
        return isChanged;
    }

    bool operator()(const WholeNumber& number) const {
        return count(label.c_str(), settings.*number.member, number.least, number.mostShown, help.c_str());
    }

    bool operator()(const PositiveNumber& number) const {
        float& value = settings.*number.member;
        if (number.infinite.empty()) {
            const bool isMoved = ImGui::SliderFloat(label.c_str(), &value, number.leastShown,
                                                    number.mostShown, "%.2f", ImGuiSliderFlags_AlwaysClamp);
            explain(help.c_str());
            return isMoved;
        }
        bool isFinite = !std::isinf(value);
        bool isChanged = tick(label.c_str(), isFinite, help.c_str());
        if (isChanged)
            value = isFinite ? number.firstFinite : std::numeric_limits<float>::infinity();
        if (isFinite) {
            isChanged |= ImGui::DragFloat(("at most##" + label).c_str(), &value, 0.1f, number.leastShown,
                                          number.mostShown, "%.2f", ImGuiSliderFlags_AlwaysClamp);
            explain(help.c_str());
        }
        return isChanged;
    }
};

} // namespace

bool drawEstimator(EstimatorSettings& settings) {
    bool isChanged = drawPresets(settings);
    for (const SettingRow& row : settingRows())
        if (row.applies(settings))
            isChanged |= std::visit(
                DrawSetting{settings, std::string(row.panelLabel), std::string(row.panelHelp)}, row.values);
    settings = agreeing(settings);
    return isChanged;
}

} // namespace lavalight
