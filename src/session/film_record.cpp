#include "session/film_record.h"

#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "film/film_identity.h"

namespace lavalight {
namespace {

SampleRanges rangesOf(const RenderSettings& settings) {
    return {{settings.image.firstSample, settings.image.firstSample + settings.stop.samples}};
}

// The window of the film, and options that decide where passes end, where the error is estimated.
std::vector<std::string> alsoDecisive(const RenderSettings& settings) {
    if (settings.stop.targetError > 0.0)
        return {"crop", "target-error", "spp", "wave-size", "band-rows"};
    return {"crop"};
}

Metadata headerOf(const RenderReport& report) {
    Metadata metadata = exrMetadata(report);
    if (report.settings.stop.targetError > 0.0) {
        metadata.emplace_back("option:wave-size", fmt::format("{}", report.settings.work.waveSize));
        metadata.emplace_back("option:band-rows", fmt::format("{}", report.settings.work.bandRows));
    }
    return metadata;
}

} // namespace

FilmFile recordFilm(const Renderer& renderer, const Scene& scene, RenderReport report) {
    FilmFile file{renderer.film().read(), rangesOf(report.settings), renderer.progress(), {}};
    report.samples = file.film.samples();
    report.ledger = makeLedger(scene, report.settings, readable(file.film.tallies), report.stop);
    file.metadata = headerOf(report);
    file.metadata.emplace_back(kRaysKey, textOf(report.rays));
    file.metadata.emplace_back(kSettingsLedger,
                               ledgerText(makeLedger(scene, report.settings, FilmTallies(), report.stop)));
    if (report.settings.image.crop)
        file.part = partOf(report.settings.image);
    return file;
}

void continueFilm(Renderer& renderer, const FilmFile& file, const std::string& name,
                  const RenderReport& report, Machines machines) {
    const auto refuse = [&](const std::string& why) {
        throw Error(fmt::format("cannot resume from {}: {}", name, why));
    };
    const Metadata ours = headerOf(report);
    const std::string difference = differences({file.metadata, "the checkpoint"}, {ours, "this render"},
                                               alsoDecisive(report.settings), machines);
    if (!difference.empty())
        refuse(fmt::format("it is of another render: {}", difference));
    if (!(file.film.layout == renderer.film().layout()))
        refuse(fmt::format("it holds the layers {}, this render takes {}", textOf(file.film.layout),
                           textOf(renderer.film().layout())));
    const SampleRange wanted = rangesOf(report.settings).front();
    if (file.ranges.size() != 1 || file.ranges.front().first != wanted.first)
        refuse(fmt::format("it is of samples {}, this render of {}", textOf(file.ranges), textOf({wanted})));
    const FilmProgress& progress = file.progress;
    if (progress.samples + progress.passSamples > report.settings.stop.samples)
        refuse(fmt::format("it has {} samples per pixel already, this render is of {}",
                           progress.samples + progress.passSamples, report.settings.stop.samples));
    if (progress.passSamples > report.settings.work.waveSize)
        refuse(fmt::format("the pass under way takes {} samples per pixel at once: give that --wave-size, "
                           "or a larger one",
                           progress.passSamples));
    renderer.continueFrom(progress, file.film);
}

} // namespace lavalight
