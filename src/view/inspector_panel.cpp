#include "view/inspector_panel.h"

#include <cmath>

#include <fmt/format.h>

#include "inspect/traced_fate.h"
#include "scene/world_position.h"
#include "view/widgets.h"

namespace lavalight {
namespace {

constexpr ImU32 kPathColor = IM_COL32(255, 200, 0, 255);
constexpr ImU32 kLightColor = IM_COL32(0, 220, 255, 255);

std::string text(const glm::vec3& v) {
    return fmt::format("{:.3g} {:.3g} {:.3g}", v.x, v.y, v.z);
}

std::string placeText(const glm::vec3& p, const glm::dvec3& origin) {
    return fmt::format("{} {} {}", worldText(p.x, origin.x, 3), worldText(p.y, origin.y, 3),
                       worldText(p.z, origin.z, 3));
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}

void drawVertex(const TracedVertex& vertex, size_t number, const Scene& scene) {
    const bool isHit = !std::isinf(vertex.t);
    ImGui::TableNextRow();
    cell(fmt::format("{}", number));
    cell(isHit ? placeText(vertex.position, scene.origin) : "");
    cell(isHit ? scene.materials[vertex.material].name : "environment");
    cell(text(vertex.throughput));
    cell(vertex.pdf > 0.0f ? fmt::format("{:.3g}", vertex.pdf) : "delta");
    cell((vertex.flags & kTracedShadowRay) == 0  ? ""
         : (vertex.flags & kTracedOccluded) != 0 ? "in shadow"
                                                 : text(vertex.direct));
    cell(fmt::format("{:.2g}", vertex.survival));
    cell(fateOf(vertex));
}

void drawVertices(const std::vector<TracedVertex>& vertices, const Scene& scene) {
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_Borders | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX;
    const float height = static_cast<float>(vertices.size() + 2) * ImGui::GetTextLineHeightWithSpacing();
    if (!ImGui::BeginTable("path", 8, flags, ImVec2(0.0f, height)))
        return;
    for (const char* name :
         {"", "position", "material", "throughput", "pdf", "light asked", "survival", "then"})
        ImGui::TableSetupColumn(name);
    ImGui::TableHeadersRow();
    for (size_t i = 0; i < vertices.size(); ++i)
        drawVertex(vertices[i], i + 1, scene);
    ImGui::EndTable();
}

} // namespace

bool drawInspection(const PixelInspection& inspection, uint32_t& sample) {
    ImGui::TextUnformatted(fmt::format("pixel {}, {}: {} of {} samples, standard error {}",
                                       inspection.pixel.x, inspection.pixel.y, text(inspection.radiance),
                                       inspection.count, text(glm::sqrt(inspection.variance)))
                               .c_str());
    sample = inspection.sample;
    const bool isChanged = count("sample", sample, 0, 0x7ffffffe, "Whose path is shown");
    ImGui::TextUnformatted(fmt::format("brings {}", text(inspection.path.radiance)).c_str());
    drawVertices(inspection.path.vertices, *inspection.scene);
    return isChanged;
}

void drawPath(const PixelInspection& inspection, const ViewState& view, const glm::vec2& window) {
    ImDrawList* const draw = ImGui::GetBackgroundDrawList();
    const Camera& camera = view.rig.camera();
    std::optional<glm::vec2> before;
    for (const TracedVertex& vertex : inspection.path.vertices) {
        if (std::isinf(vertex.t))
            break;
        const auto at = project(camera, window.x / window.y, vertex.position);
        if (at && before)
            draw->AddLine(ImVec2(before->x * window.x, before->y * window.y),
                          ImVec2(at->x * window.x, at->y * window.y), kPathColor, 2.0f);
        if (at) {
            const bool isLit =
                (vertex.flags & kTracedShadowRay) != 0 && (vertex.flags & kTracedOccluded) == 0;
            draw->AddCircleFilled(ImVec2(at->x * window.x, at->y * window.y), 4.0f,
                                  isLit ? kLightColor : kPathColor);
        }
        before = at;
    }
}

} // namespace lavalight
