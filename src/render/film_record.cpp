#include "render/film_record.h"

#include <numeric>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "render/film_identity.h"

namespace lavalight {
namespace {

constexpr const char* kSeconds = "render-seconds";
constexpr const char* kRays = "film:rays";

SampleRanges rangesOf(const RenderSettings& settings) {
    return {{settings.firstSample, settings.firstSample + settings.samples}};
}

// What an error estimate is asked at: the ends of passes, which these decide.
std::vector<std::string> alsoDecisive(const RenderSettings& settings) {
    if (settings.targetError > 0.0)
        return {"target-error", "spp", "wave-size", "band-rows"};
    return {};
}

Metadata headerOf(const RenderReport& report) {
    Metadata metadata = exrMetadata(report);
    if (report.settings.targetError > 0.0) {
        metadata.emplace_back("option:wave-size", fmt::format("{}", report.settings.waveSize));
        metadata.emplace_back("option:band-rows", fmt::format("{}", report.settings.bandRows));
    }
    return metadata;
}

uint64_t samplesIn(const RawFilm& film) {
    const auto counts = film.words.begin() + static_cast<ptrdiff_t>(kCountPlane * film.pixels());
    return std::accumulate(counts, film.words.end(), uint64_t{0});
}

std::string textOf(const RayCounts& rays) {
    return fmt::format("{} {} {}", rays.camera, rays.indirect, rays.shadow);
}

} // namespace

FilmFile recordFilm(const Renderer& renderer, const Scene& scene, RenderReport report) {
    FilmFile file{renderer.film().read(), rangesOf(report.settings), renderer.progress(), {}};
    report.samples = samplesIn(file.film);
    report.ledger = makeLedger(scene, report.settings, readable(file.film.tallies), report.stop);
    file.metadata = headerOf(report);
    file.metadata.emplace_back(kRays, textOf(report.rays));
    file.metadata.emplace_back(kSettingsLedger,
                               ledgerText(makeLedger(scene, report.settings, FilmTallies(), report.stop)));
    return file;
}

FilmCost costOf(const FilmFile& file) {
    FilmCost cost;
    std::istringstream(valueOf(file.metadata, kSeconds)) >> cost.seconds;
    std::istringstream(valueOf(file.metadata, kRays)) >> cost.rays.camera >> cost.rays.indirect >>
        cost.rays.shadow;
    return cost;
}

void setCost(FilmFile& file, const FilmCost& cost) {
    setValue(file.metadata, kSeconds, fmt::format("{:.3f}", cost.seconds));
    setValue(file.metadata, kRays, textOf(cost.rays));
}

FilmCost operator+(const FilmCost& a, const FilmCost& b) {
    return {a.seconds + b.seconds, a.rays + b.rays};
}

void continueFilm(Renderer& renderer, const FilmFile& file, const std::string& name,
                  const RenderReport& report) {
    const auto refuse = [&](const std::string& why) {
        throw Error(fmt::format("cannot resume from {}: {}", name, why));
    };
    const Metadata ours = headerOf(report);
    const std::string difference =
        differences({file.metadata, "the checkpoint"}, {ours, "this render"}, alsoDecisive(report.settings));
    if (!difference.empty())
        refuse(fmt::format("it is of another render: {}", difference));
    const SampleRange wanted = rangesOf(report.settings).front();
    if (file.ranges.size() != 1 || file.ranges.front().first != wanted.first)
        refuse(fmt::format("it is of samples {}, this render of {}", textOf(file.ranges), textOf({wanted})));
    const FilmProgress& progress = file.progress;
    if (progress.samples + progress.passSamples > report.settings.samples)
        refuse(fmt::format("it has {} samples per pixel already, this render is of {}",
                           progress.samples + progress.passSamples, report.settings.samples));
    if (progress.passSamples > report.settings.waveSize)
        refuse(fmt::format("the pass under way takes {} samples per pixel at once: give that --wave-size, "
                           "or a larger one",
                           progress.passSamples));
    renderer.continueFrom(progress, file.film);
}

} // namespace lavalight
