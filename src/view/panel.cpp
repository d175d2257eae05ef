#include "view/panel.h"

#include <algorithm>

#include <fmt/format.h>

#include "view/controls.h"
#include "view/estimator_panel.h"
#include "view/inspector_panel.h"
#include "view/scene_panel.h"
#include "view/screen_panel.h"
#include "view/statistics_panel.h"
#include "view/widgets.h"

namespace lavalight {
namespace {

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
const ImVec4 kErrorColor(1.0f, 0.5f, 0.4f, 1.0f);

void chooseSchedule(ViewState& view) {
    std::vector<SettingName<Schedule>> names;
    for (const SettingName<Schedule>& name : settingNames<Schedule>())
        if (view.canBeHosted || name.value != Schedule::hosted)
            names.push_back(name);
    if (chooseAmong<Schedule>(
            "schedule", names, view.settings.work.schedule,
            "One kernel for whole paths, or one for each step with queues between them, or rays "
            "traced by the host"))
        view.settings.work.accelerator = RayAccelerator::automatic; // one of that schedule
}

void drawEstimators(ViewState& view) {
    if (ImGui::CollapsingHeader("Estimator", ImGuiTreeNodeFlags_DefaultOpen)) {
        ImGui::PushID("left");
        drawEstimator(view.settings.estimator);
        chooseSchedule(view);
        ImGui::PopID();
    }
    if (view.isSplit && ImGui::CollapsingHeader("Estimator on the right", ImGuiTreeNodeFlags_DefaultOpen)) {
        ImGui::PushID("right");
        drawEstimator(view.other);
        ImGui::PopID();
    }
}

} // namespace

PanelAnswer
drawPanel(ViewState& view,
          const std::pair<std::optional<LiveStatistics>, std::optional<LiveStatistics>>& statistics) {
    PanelAnswer answer;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos(ImVec2(em, em), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(24.0f * em, 39.0f * em), ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Lavalight", &view.showsPanel, ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::PushItemWidth(10.0f * em);
        ImGui::TextDisabled("F1: keys, Tab: hides this");
        if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen))
            drawScreen(view, statistics.first ? statistics.first->exposure : view.tone.exposure);
        if (ImGui::CollapsingHeader("Render", ImGuiTreeNodeFlags_DefaultOpen)) {
            const bool hasOther = view.isSplit && view.other != view.settings.estimator;
            if (statistics.first)
                drawStatistics(hasOther ? "left: " : "", *statistics.first);
            if (hasOther && statistics.second)
                drawStatistics("right: ", *statistics.second);
            answer.wantsSave = ImGui::Button("save EXR and PNG");
        }
        drawEstimators(view);
        if (ImGui::CollapsingHeader("Scene"))
            answer.wantsScene = drawScene(view);
        ImGui::PopItemWidth();
    }
    ImGui::End();
    return answer;
}

bool drawInspector(const PixelInspection& inspection, uint32_t& sample) {
    bool isChanged = false;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos(ImVec2(em, em), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(44.0f * em, 16.0f * em), ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Pixel", nullptr, ImGuiWindowFlags_NoSavedSettings))
        isChanged = drawInspection(inspection, sample);
    ImGui::End();
    return isChanged;
}

void drawSplit(ViewState& view, const glm::vec2& window) {
    const float x = view.splitAt * window.x;
    const float reach = 0.5f * ImGui::GetFontSize();
    ImGui::GetBackgroundDrawList()->AddLine(ImVec2(x, 0.0f), ImVec2(x, window.y),
                                            IM_COL32(255, 255, 255, 160));
    ImGui::SetNextWindowPos(ImVec2(x - reach, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(2.0f * reach, window.y));
    ImGui::SetNextWindowBgAlpha(0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
    ImGui::Begin("split", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::SetCursorPos(ImVec2(0.0f, 0.0f));
    ImGui::InvisibleButton("handle", ImVec2(2.0f * reach, window.y));
    if (ImGui::IsItemActive())
        view.splitAt = std::clamp(ImGui::GetIO().MousePos.x / window.x, 0.05f, 0.95f);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void drawKeys(bool& isOpen) {
    if (ImGui::Begin("Keys", &isOpen, kPlain) && ImGui::BeginTable("keys", 2)) {
        for (const auto& [key, does] : controlHelp()) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(key.data(), key.data() + key.size());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(does.data(), does.data() + does.size());
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void drawMessages(std::vector<std::pair<std::string, bool>>& messages, const glm::vec2& window) {
    if (messages.empty())
        return;
    bool isOpen = true;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos(ImVec2(0.5f * window.x, window.y - em), ImGuiCond_Always, ImVec2(0.5f, 1.0f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(10.0f * em, 0.0f), ImVec2(0.95f * window.x, 0.6f * window.y));
    if (ImGui::Begin("Messages", &isOpen, kPlain))
        for (const auto& [text, isError] : messages)
            ImGui::TextColored(isError ? kErrorColor : ImVec4(1.0f, 1.0f, 1.0f, 1.0f), "%s", text.c_str());
    ImGui::End();
    if (!isOpen)
        messages.clear();
}

} // namespace lavalight
