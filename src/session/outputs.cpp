#include "session/outputs.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "image/exr.h"
#include "image/png.h"

namespace lavalight {
namespace {

void warnOfOverlaps(RenderReport& report, const Scene& scene) {
    if (report.tallies.overlaps == 0)
        return;
    report.warnings.push_back(overlapText(scene, report.tallies));
    spdlog::warn("{}", report.warnings.back());
}

void addPartsOfStages(RenderReport& report, const RenderJob& job) {
    report.stages = job.watch.stages();
    report.stages.emplace_back("prepareBvh", job.renderer->scene().accelerator().buildSeconds());
    report.stages.emplace_back("prepareKernels", job.renderer->kernels().seconds());
    if (job.toFirstSamples)
        report.stages.emplace_back("processToFirstSamples", *job.toFirstSamples);
}

} // namespace

void requireOutputs(const Outputs& outputs) {
    const std::array<std::string, 4> files{outputs.exr, outputs.png, outputs.report, outputs.checkpoint};
    for (auto file = files.begin(); file != files.end(); ++file) {
        if (file->empty())
            continue;
        if (std::find(files.begin(), file, *file) != file)
            throw UsageError(fmt::format("{} cannot hold two outputs: give each a file of its own", *file));
        requireWritable(*file);
    }
}

void writeOutputs(RenderJob& job, const Outputs& outputs, const OutputStyle& style, ToneMapper* toneMapper) {
    RenderReport& report = job.report;
    const Rendering rendering = job.renderer->rendering();
    fillResults(report, *job.renderer, *job.device, rendering, job.scene);
    warnOfOverlaps(report, job.scene);
    report.rays = report.rays + job.before.rays;
    if (!outputs.exr.empty() && style.keepsFilm)
        writeFilmFile(outputs.exr, job.film());
    else if (!outputs.exr.empty())
        writeExr(outputs.exr, rendering, exrMetadata(report));
    if (!outputs.png.empty()) {
        assert(toneMapper != nullptr);
        report.tone = style.tone;
        writePng(outputs.png, report.settings.image.width, report.settings.image.height,
                 toneMapper->map(job.renderer->film(), style.tone));
    }
    job.watch.lap("write");
    addPartsOfStages(report, job);
    if (!outputs.report.empty())
        writeFileAtomically(outputs.report, reportJson(report));
}

} // namespace lavalight
