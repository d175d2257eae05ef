#include "view/statistics_panel.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "view/widgets.h"

namespace lavalight {
namespace {

void line(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

double perSecond(uint64_t count, double seconds) {
    return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0;
}

void drawKernels(const LiveStatistics& s) {
    double total = 0.0;
    for (const auto& [name, time] : s.kernels)
        total += time.seconds;
    for (const auto& [name, time] : s.kernels) {
        const double share = total > 0.0 ? time.seconds / total : 0.0;
        ImGui::ProgressBar(static_cast<float>(share), ImVec2(-1.0f, 0.0f),
                           fmt::format("{} {:.0f} %", name, 100.0 * share).c_str());
        explain("Its share of the time of all kernels, and of the rays on the host");
    }
}

// Draws how many of all paths come to each bounce, and how many end there, in per cent.
void drawPaths(const std::vector<uint64_t>& raysPerBounce) {
    if (raysPerBounce.empty() || raysPerBounce.front() == 0) {
        ImGui::TextDisabled("queues: not with the schedule fused");
        return;
    }
    std::vector<float> alive;
    std::vector<float> ending;
    const auto all = static_cast<float>(raysPerBounce.front());
    for (size_t i = 0; i < raysPerBounce.size() && (raysPerBounce[i] > 0 || i == 0); ++i) {
        const uint64_t next = i + 1 < raysPerBounce.size() ? raysPerBounce[i + 1] : 0;
        alive.push_back(100.0f * static_cast<float>(raysPerBounce[i]) / all);
        ending.push_back(100.0f * static_cast<float>(raysPerBounce[i] - next) / all);
    }
    const ImVec2 size(-1.0f, 4.0f * ImGui::GetFontSize());
    ImGui::PlotLines("##queues", alive.data(), static_cast<int>(alive.size()), 0, "queue by bounce, %", 0.0f,
                     100.0f, size);
    ImGui::PlotHistogram("##lengths", ending.data(), static_cast<int>(ending.size()), 0,
                         "path lengths, % ending at a bounce", 0.0f,
                         *std::max_element(ending.begin(), ending.end()), size);
}

} // namespace

void drawStatistics(const char* title, const LiveStatistics& s) {
    ImGui::PushID(title);
    line(fmt::format("{}{} samples in {:.1f} s", title, s.samples, s.seconds));
    line(fmt::format("{:.2f} M paths/s, {:.2f} M rays/s", perSecond(s.paths, s.seconds) * 1e-6,
                     perSecond(s.rays.total(), s.seconds) * 1e-6));
    line(s.error < 0.0 ? "error not known yet"
                       : fmt::format("error {:.1f} % (relMSE {:.2g})", 100.0 * std::sqrt(s.error), s.error));
    explain("Estimated from the samples' variance as if they were independent; Sobol's are better than that");
    if (s.denoisedSamples > 0)
        line(fmt::format("denoised: {} of these samples", s.denoisedSamples));
    drawKernels(s);
    drawPaths(s.raysPerBounce);
    ImGui::PopID();
}

} // namespace lavalight
