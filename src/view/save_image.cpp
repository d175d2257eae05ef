#include "view/save_image.h"

#include <fmt/format.h>

#include "image/exr.h"
#include "image/png.h"
#include "session/report.h"

namespace lavalight {
namespace {

Metadata metadataOf(const LiveSide& side, const gpu::Device& device, const Rendering& rendering) {
    const LiveRequest& request = side.request();
    RenderReport report;
    fillInputs(report, *request.scene, side.renderer().settings());
    if (request.shaders)
        report.settings.provenance.changedShaders = request.shaders->changed();
    report.camera = request.camera.name;
    report.renderSeconds = side.seconds();
    report.stop = side.hasWork() ? StopReason::interrupted : StopReason::samples;
    fillResults(report, side.renderer(), device, rendering, *request.scene);
    return exrMetadata(report);
}

} // namespace

std::string saveImage(const LiveSide& side, ToneMapper& tone, const gpu::Device& device,
                      const Outputs& files) {
    std::string written;
    if (!files.exr.empty()) {
        const Rendering rendering = side.renderer().rendering();
        writeExr(files.exr, rendering, metadataOf(side, device, rendering));
        written = files.exr;
    }
    if (!files.png.empty()) {
        const Film& film = side.renderer().film();
        writePng(files.png, film.width(), film.height(), tone.map(film, side.request().tone));
        written += (written.empty() ? "" : ", ") + files.png;
    }
    return fmt::format("saved {}", written);
}

} // namespace lavalight
