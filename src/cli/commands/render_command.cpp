#include "cli/commands/render_command.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/log.h"
#include "base/os/file_watch.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "session/builtin.h"
#include "session/frame_sequence.h"
#include "session/lit_scene.h"

namespace lavalight {
namespace {

void printSummary(const RenderReport& report) {
    const PixelWindow window = windowOf(report.settings.image);
    fmt::print(
        "{}: {}x{}, {} samples per pixel in {:.2f} s on {} ({:.2f} M samples/s, {:.2f} M rays/s), bias "
        "ledger: {}\n",
        report.scene, window.width, window.height, report.samples / window.pixels(), report.renderSeconds,
        report.device.name, static_cast<double>(report.samples) / report.renderSeconds * 1e-6,
        static_cast<double>(report.rays.total()) / report.renderSeconds * 1e-6, ledgerText(report.ledger));
    std::fflush(stdout); // somebody who watches wants to know now
}

} // namespace

RenderCommand::RenderCommand(CLI::App& app)
    : Command(app, "render", "Render a scene to an image"), options_(parser()), frames_(parser()),
      shaders_(parser()), checkpoints_(parser()) {
    shaders_.declareWatch(parser());
    parser()
        .add_option("input", scene_,
                    "Built-in scene (" + fmt::format("{}", fmt::join(builtinNames(), ", ")) +
                        ") or .gltf or .glb file")
        ->type_name("SCENE");
    parser()
        .add_option(
            "-o,--output", pictures_,
            "Picture: .exr (radiance) or .png (sRGB, to look at); may be given once for each; default: "
            "the scene's name and .exr")
        ->type_name("OUT.exr|OUT.png")
        ->default_str("")
        ->allow_extra_args(false);
    parser().add_option("--png", png_, "Another way to write -o OUT.png")->type_name("OUT.png");
    parser()
        .add_option("--report", outputs_.report, "JSON report: times, rays, memory, ledger")
        ->type_name("REPORT.json");
    parser().add_flag("--quiet", quiet_, "No messages but errors, no summary");
}

RenderPlan RenderCommand::plan() const {
    RenderPlan plan = options_.plan(scene_);
    if (frames_.isTurntable() && plan.camera.view == NamedView::none)
        plan.camera.view = NamedView::threeQuarter;
    return plan;
}

void RenderCommand::checkOptions() const {
    if (options_.hasBackdrop() && outputs_.png.empty())
        throw UsageError("--background: a colour is for a PNG; give -o OUT.png, or --background transparent");
    if (options_.hasTone() && outputs_.png.empty())
        throw UsageError("--tonemap and --exposure are for a PNG; give -o OUT.png, or leave them out");
    if (options_.layers() != 0 && outputs_.exr.empty() && checkpoints_.given().empty())
        throw UsageError("--aov is for an EXR; give -o OUT.exr, or leave it out");
    const bool isOfSequence = frames_.isAsked() || frames_.single();
    if ((options_.layers() >> kMotionPlane & 1u) != 0 && !isOfSequence)
        throw UsageError(
            "--aov motion: motion leads to the next frame; give --frames, --frame or --turntable");
    if (isOfSequence && shaders_.isWatching())
        throw UsageError(
            "--watch renders one image over and over, --frames and --turntable several: give one "
            "of them");
}

void RenderCommand::takeOutputs() {
    for (const std::string& picture : pictures_)
        addPicture(outputs_, picture, "-o");
    if (!png_.empty()) {
        Outputs asked;
        addPicture(asked, png_, "--png");
        if (asked.png.empty())
            throw UsageError(fmt::format("--png: {} has the ending of another format; give it to -o", png_));
        addPicture(outputs_, png_, "--png");
    }
    if (outputs_.exr.empty() && outputs_.png.empty())
        outputs_.exr = std::filesystem::path(scene_).stem().string() + ".exr";
}

Outputs RenderCommand::outputsOf(uint32_t frame) const {
    return {numberedFile(outputs_.exr, frame),
            numberedFile(outputs_.png, frame),
            numberedFile(outputs_.report, frame),
            {}};
}

void RenderCommand::requireOutputsApart(const RenderPlan& plan) const {
    InputFiles inputs = filesOfLitScene(plan.scene, plan.settings.lighting);
    shaders_.addFiles(inputs);
    if (frames_.isAsked()) {
        const FrameRange range = frames_.range();
        for (uint32_t frame = range.first; frame < range.end; ++frame)
            requireApart(outputsOf(frame), inputs);
        return;
    }
    Outputs outputs = outputs_;
    outputs.checkpoint = checkpoints_.given();
    requireApart(outputs, inputs);
}

int RenderCommand::run() {
    if (quiet_)
        configureLog(LogLevel::quiet);
    takeOutputs();
    const RenderPlan plan = this->plan();
    checkOptions();
    requireOutputsApart(plan);
    outputs_.checkpoint = checkpoints_.file(plan.settings);
    RenderSession session(plan);
    if (const auto overlay = shaders_.overlay())
        session.use(overlay);
    if (frames_.isAsked())
        return runSequence(session);
    requireOutputs(outputs_);
    Checkpoint checkpoint(outputs_.checkpoint, checkpoints_.interval());
    if (shaders_.isWatching())
        return runWatching(session);
    const std::optional<uint32_t> frame = frames_.single();
    return renderMoment(session,
                        frame ? turnTo(*frame, session) : Moment{options_.scene().importOptions(), {}},
                        outputs_, checkpoint);
}

ImportOptions RenderCommand::momentOf(uint32_t frame) const {
    return frames_.isTurntable() ? options_.scene().importOptions()
                                 : options_.scene().importOptionsAt(frames_.range().secondsOf(frame));
}

RenderCommand::Moment RenderCommand::turnTo(uint32_t frame, RenderSession& session) const {
    if (const std::optional<float> turns = frames_.turnsOf(frame))
        session.turn(*turns);
    return {momentOf(frame), RenderSession::NextMoment{momentOf(frame + 1), frames_.turnsOf(frame + 1)}};
}

int RenderCommand::runSequence(RenderSession& session) const {
    const FrameRange range = frames_.range();
    for (uint32_t frame = range.first; frame < range.end; ++frame) {
        const Outputs files = outputsOf(frame);
        requireOutputs(files);
        Checkpoint none({}, {});
        if (const int code = renderMoment(session, turnTo(frame, session), files, none); code != 0)
            return code;
    }
    return 0;
}

int RenderCommand::renderMoment(RenderSession& session, const Moment& moment, const Outputs& outputs,
                                Checkpoint& checkpoint) const {
    RenderJob job = session.prepare(moment.now, outputs, moment.next);
    const InterruptGuard guard; // until all files are written: Ctrl-C loses no image
    {
        ProgressBar progress(!quiet_);
        session.render(job, checkpoint, checkpoints_.isResuming(), [&](double fraction) {
            progress.show(fraction);
            return !guard.interrupted();
        });
    }
    finishImage(session, job, outputs);
    checkpoint.requireWritten();
    const bool isInterrupted = job.report.stop == StopReason::interrupted;
    session.finish(std::move(job));
    return isInterrupted ? guard.exitCode() : 0;
}

// Renders until Ctrl-C. A save that changes a kernel ends the render that is under way; any other leaves it
// alone.
int RenderCommand::runWatching(RenderSession& session) const {
    FileWatch saves(shaders_.folder());
    RenderJob job = session.prepare(options_.scene().importOptions(), outputs_);
    const InterruptGuard guard;
    std::shared_ptr<ShaderOverlay> next;
    const auto look = [&](std::chrono::milliseconds atMost) {
        const std::vector<std::string> changes = saves.wait(atMost);
        next = changes.empty() ? nullptr : shaders_.reread(changes, session, job);
    };
    while (!guard.interrupted()) {
        {
            ProgressBar progress(!quiet_);
            job.takeSamples([&](double fraction) {
                progress.show(fraction);
                look(std::chrono::milliseconds(0));
                return !next && !guard.interrupted();
            });
        }
        if (!next)
            finishImage(session, job, outputs_);
        while (!next && !guard.interrupted())
            look(std::chrono::hours(1));
        if (next) {
            session.use(next);
            session.reload(job);
            spdlog::info("compiled in {:.2f} s", job.watch.stages().back().second);
        }
    }
    return guard.exitCode();
}

void RenderCommand::finishImage(RenderSession& session, RenderJob& job, const Outputs& outputs) const {
    session.write(job, outputs);
    if (!quiet_)
        printSummary(job.report);
}

} // namespace lavalight
