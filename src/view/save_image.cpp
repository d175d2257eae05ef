#include "view/save_image.h"

#include <algorithm>

#include <fmt/format.h>

#include "film/film_layout.h"
#include "image/exr.h"
#include "image/png.h"
#include "session/denoised.h"
#include "session/report.h"

namespace lavalight {
namespace {

RenderReport reportOf(const LiveSide& side, const gpu::Device& device, const Rendering& rendering,
                      bool isDenoised) {
    const LiveRequest& request = side.request();
    RenderSettings settings = side.renderer().settings();
    settings.layers = request.asked | (isDenoised ? kDenoisingLayers : 0u);
    RenderReport report;
    fillInputs(report, *request.scene, settings);
    if (request.shaders)
        report.settings.provenance.changedShaders = request.shaders->changed();
    report.camera = request.camera.name;
    report.renderSeconds = side.seconds();
    report.stop = side.hasWork() ? StopReason::interrupted : StopReason::samples;
    fillResults(report, side.renderer(), device, rendering, *request.scene);
    return report;
}

} // namespace

std::string saveImage(const LiveSide& side, const SavedPicture& picture, ToneMapper& tone,
                      const gpu::Device& device, const Outputs& files) {
    const LiveRequest& request = side.request();
    Rendering rendering = side.renderer().rendering();
    RenderReport report = reportOf(side, device, rendering, picture.isDenoised);
    if (picture.isDenoised)
        addDenoised(report.ledger, rendering, Denoiser(), request.quality, request.asked,
                    side.renderer().frame().lensRadius == 0.0f);
    else
        removeGuides(rendering, request.asked);
    std::string written;
    if (!files.exr.empty()) {
        writeExr(files.exr, rendering, exrMetadata(report));
        written = files.exr;
    }
    if (!files.png.empty()) {
        ToneSettings shown = request.tone;
        shown.exposure = picture.exposure;
        const Film& film = side.renderer().film();
        const std::vector<uint32_t> pixels =
            picture.isDenoised ? denoisedPixels(rendering, tone, shown) : tone.map(film, shown);
        writePng(files.png, film.width(), film.height(), pixels, pngTexts(shown));
        written += (written.empty() ? "" : ", ") + files.png;
    }
    return fmt::format("saved {}", written);
}

} // namespace lavalight
