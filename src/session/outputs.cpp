#include "session/outputs.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/os/file_lock.h"
#include "base/version.h"
#include "film/film_shadow.h"
#include "film/id_layers.h"
#include "image/exr.h"
#include "image/png.h"
#include "render/setting_names.h"
#include "session/denoise_names.h"
#include "session/denoised.h"
#include "session/exposure.h"

namespace lavalight {
namespace {

void warn(RenderReport& report, const std::string& message) {
    if (message.empty())
        return;
    report.warnings.push_back(message);
    spdlog::warn("{}", message);
}

std::vector<Layer> denoisedLayers(const Rendering& rendering) {
    std::vector<Layer> layers;
    for (const char* name : {kDenoisedLayer, kDenoisedCoverage, kDenoisedShadow})
        if (const Layer* layer = rendering.find(name))
            layers.push_back(*layer);
    return layers;
}

void addPartsOfStages(RenderReport& report, const RenderJob& job) {
    report.stages = job.watch.stages();
    report.stages.emplace_back("prepareBvh", job.renderer->scene().accelerator().buildSeconds());
    report.stages.emplace_back("prepareKernels", job.renderer->kernels().seconds());
    if (job.toFirstSamples)
        report.stages.emplace_back("processToFirstSamples", *job.toFirstSamples);
}

// What comes into being.
std::vector<std::filesystem::path> filesOf(const Outputs& outputs) {
    std::vector<std::filesystem::path> files;
    for (const std::string& file : {outputs.exr, outputs.png, outputs.report, outputs.checkpoint})
        if (!file.empty())
            files.emplace_back(file);
    if (!outputs.checkpoint.empty())
        files.push_back(lockFileOf(outputs.checkpoint));
    return files;
}

} // namespace

void addPicture(Outputs& outputs, const std::string& file, const std::string& option) {
    std::string ending = std::filesystem::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending != ".exr" && ending != ".png")
        throw UsageError(fmt::format("{}: \"{}\" has no ending that names a format of pictures; give .exr "
                                     "(radiance) or .png (to look at)",
                                     option, file));
    std::string& place = ending == ".exr" ? outputs.exr : outputs.png;
    if (!place.empty())
        throw UsageError(fmt::format("{}: {} and {} are both {} files; one of a kind is written", option,
                                     place, file, ending));
    place = file;
}

void requireApart(const Outputs& outputs, const InputFiles& inputs) {
    std::vector<std::filesystem::path> files = filesOf(outputs);
    for (auto file = files.begin(); file != files.end(); ++file) {
        for (auto other = files.begin(); other != file; ++other)
            if (isSameFile(*file, *other))
                throw UsageError(
                    fmt::format("{} cannot hold two outputs: give each a file of its own", file->string()));
        inputs.requireApart(*file);
    }
    if (!outputs.checkpoint.empty())
        for (const std::filesystem::path& file : unfinishedFiles(outputs.checkpoint))
            inputs.requireApart(file);
    for (const std::string& file : {outputs.exr, outputs.png, outputs.report})
        if (!file.empty() && isLocked(file))
            throw UsageError(
                fmt::format("cannot write {}: it is the checkpoint of a render that is under way; give the "
                            "output another name",
                            file));
}

void requireOutputs(const Outputs& outputs) {
    for (const std::string& file : {outputs.exr, outputs.png, outputs.report, outputs.checkpoint})
        if (!file.empty())
            requireWritable(file);
}

PngTexts pngTexts(const ToneSettings& tone) {
    return {{"Software", fmt::format("Lavalight {}", kVersion)},
            {"lavalight:tonemap", std::string(nameOf(tone.curve))},
            {"lavalight:exposure", fmt::format("{}", tone.exposure)}};
}

void addDenoised(std::vector<LedgerEntry>& ledger, Rendering& rendering, const Denoiser& denoiser,
                 DenoiseQuality quality, uint32_t asked, bool isSharp) {
    denoise(rendering, denoiser, quality, asked, isSharp);
    ledger.push_back({"denoised", fmt::format("the PNG and the layer {}, by Open Image Denoise {}, {}",
                                              kDenoisedLayer, denoiser.version(), nameOf(quality))});
}

std::vector<uint32_t> denoisedPixels(const Rendering& rendering, ToneMapper& toneMapper,
                                     const ToneSettings& tone) {
    const Layer* denoised = rendering.find(kDenoisedLayer);
    assert(denoised != nullptr);
    return toneMapper.map(denoised->mean, rendering.findMean(kDenoisedCoverage), tone,
                          rendering.findMean(kDenoisedShadow));
}

FinishedImage finishImage(RenderJob& job, OutputStyle& style, ToneMapper* toneMapper) {
    RenderReport& report = job.report;
    FinishedImage image;
    image.rendering = job.renderer->rendering();
    Rendering& rendering = image.rendering;
    if (report.settings.image.crop)
        rendering.place = placeOf(partOf(report.settings.image));
    fillResults(report, *job.renderer, *job.device, rendering, job.scene);
    if (style.denoiser) {
        const bool isSharp = job.renderer->frame().lensRadius == 0.0f;
        addDenoised(report.ledger, rendering, *style.denoiser, style.quality, style.layers, isSharp);
        job.watch.lap("denoise");
    }
    if (report.tallies.crowdedPaths > 0)
        warn(report, crowdedText(job.scene, report.tallies));
    report.rays = report.rays + job.before.rays;
    image.holdsFilm = style.keepsFilm;
    if (style.keepsFilm)
        image.film = job.film();
    addIdLayers(job.renderer->film().ids(), rendering.sampleCounts, exrMetadata(report), image.ids);
    addPartsOfStages(report, job);
    if (toneMapper == nullptr)
        return image;
    const bool exposesByImage = std::exchange(style.exposesByImage, false);
    if (exposesByImage)
        style.tone.exposure = autoExposure(rendering);
    image.tone = report.tone = style.tone;
    image.pixels = rendering.find(kDenoisedLayer) != nullptr
                       ? denoisedPixels(rendering, *toneMapper, style.tone)
                       : toneMapper->map(job.renderer->film(), style.tone);
    const std::optional<Image> coverage = coverageWithoutShadow(rendering);
    const bool isDark = !job.scene.environmentMap && !report.settings.lighting.constant;
    warn(report,
         extremesText(image.pixels, coverage ? &*coverage : nullptr,
                      fmt::format("{}{}{}", exposesByImage ? "" : "--exposure auto",
                                  !exposesByImage && isDark ? ", or " : "", isDark ? "--env studio" : "")));
    return image;
}

void writeImageExr(const std::filesystem::path& path, const FinishedImage& image, const Metadata& metadata) {
    if (image.holdsFilm)
        writeFilmFile(path, image.film.value(), denoisedLayers(image.rendering));
    else
        writeExr(path, image.rendering, metadata, image.ids);
}

void writeImagePng(const std::filesystem::path& path, const FinishedImage& image) {
    assert(image.tone);
    const Image& radiance = image.rendering.radiance();
    writePng(path, radiance.width, radiance.height, image.pixels, pngTexts(*image.tone));
}

void writeOutputs(RenderJob& job, const Outputs& outputs, OutputStyle& style, ToneMapper* toneMapper) {
    assert(outputs.png.empty() || toneMapper != nullptr);
    const FinishedImage image = finishImage(job, style, outputs.png.empty() ? nullptr : toneMapper);
    if (!outputs.exr.empty())
        writeImageExr(outputs.exr, image, exrMetadata(job.report));
    if (!outputs.png.empty())
        writeImagePng(outputs.png, image);
    job.watch.lap("write");
    addPartsOfStages(job.report, job);
    if (!outputs.report.empty())
        writeFileAtomically(outputs.report, reportJson(job.report));
}

} // namespace lavalight
