#include "session/render_job.h"

#include <utility>

#include "base/os/process_time.h"

namespace lavalight {

double Stopwatch::lap(const std::string& stage) {
    const double seconds = sinceLap();
    last_ = std::chrono::steady_clock::now();
    stages_.emplace_back(stage, seconds);
    return seconds;
}

double Stopwatch::sinceLap() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
}

void RenderJob::describeInputs(const std::vector<std::string>& changedShaders) {
    fillInputs(report, scene, renderer->settings());
    report.settings.provenance.changedShaders = changedShaders;
    report.device = device->description();
    report.content = fingerprintsOf(*renderer);
}

void RenderJob::takeSamples(const KeepGoing& keepGoing) {
    report.stop = renderer->render([&](double fraction) {
        if (!toFirstSamples)
            toFirstSamples = secondsSinceProcessStart();
        return keepGoing(fraction);
    });
    report.renderSeconds = before.seconds + watch.lap("render");
}

FilmFile RenderJob::film() const {
    RenderReport now = report;
    now.rays = renderer->waves().rays() + before.rays;
    return recordFilm(*renderer, scene, std::move(now));
}

void RenderJob::resumeFrom(Checkpoint& checkpoint) {
    const std::optional<FilmFile> film = checkpoint.read();
    if (!film)
        return;
    // A film that lacks no sample is developed on any machine, since none of its bits come from this one.
    const bool isOnlyShown =
        !writesExr && film->isComplete() && countOf(film->ranges) == report.settings.stop.samples;
    continueFilm(*renderer, *film, checkpoint.file(), report,
                 isOnlyShown ? Machines::any : Machines::ofOneKind);
    before = costOf(*film);
}

void RenderJob::keep(Checkpoint& checkpoint) {
    report.stop = StopReason::interrupted;
    report.renderSeconds = before.seconds + watch.sinceLap();
    checkpoint.write([&] { return film(); });
}

} // namespace lavalight
