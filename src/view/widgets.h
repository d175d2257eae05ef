// Small pieces of the panel that repeat.
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "render/setting_names.h"

namespace lavalight {

// Says what the item before is for while the mouse is over it.
inline void explain(const char* text) {
    if (!ImGui::IsItemHovered())
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// What a list shows of a file's names, which may be empty.
inline std::string nameOrNumber(const std::vector<std::string>& names, size_t index) {
    return names[index].empty() ? "number " + std::to_string(index) : names[index];
}

// Draws an entry of a list, whose `text` may come twice or hold ImGui's marks. Returns whether it was chosen.
inline bool offer(size_t index, const std::string& text, bool isChosen) {
    const bool isPicked = ImGui::Selectable(("##" + std::to_string(index)).c_str(), isChosen);
    ImGui::SameLine(0.0f, 0.0f);
    ImGui::TextUnformatted(text.c_str());
    return isPicked;
}

// Draws a setting by its names on the command line. Returns whether it was changed.
template <typename Value>
bool choose(const char* label, Value& value, const char* meaning) {
    bool isChanged = false;
    if (ImGui::BeginCombo(label, std::string(nameOf(value)).c_str())) {
        for (const SettingName<Value>& name : settingNames<Value>()) {
            if (ImGui::Selectable(std::string(name.name).c_str(), name.value == value)) {
                isChanged = value != name.value;
                value = name.value;
            }
        }
        ImGui::EndCombo();
    }
    explain(meaning);
    return isChanged;
}

inline bool tick(const char* label, bool& value, const char* meaning) {
    const bool isChanged = ImGui::Checkbox(label, &value);
    explain(meaning);
    return isChanged;
}

// Draws a number from `least` to `most`. Returns whether it was changed.
inline bool count(const char* label, uint32_t& value, uint32_t least, uint32_t most, const char* meaning) {
    int now = static_cast<int>(value);
    const bool isMoved = ImGui::DragInt(label, &now, 0.2f, static_cast<int>(least), static_cast<int>(most),
                                        "%d", ImGuiSliderFlags_AlwaysClamp);
    explain(meaning);
    if (!isMoved || now == static_cast<int>(value))
        return false;
    value = static_cast<uint32_t>(now);
    return true;
}

} // namespace lavalight
