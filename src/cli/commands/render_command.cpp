#include "cli/commands/render_command.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/os/file_watch.h"
#include "base/os/process_time.h"
#include "cli/interrupt.h"
#include "cli/options/environment_options.h"
#include "cli/progress.h"
#include "image/exr.h"
#include "image/png.h"
#include "render/renderer.h"
#include "render/tone_mapper.h"
#include "session/builtin.h"
#include "session/report.h"

namespace lavalight {
namespace {

void warnOfOverlaps(RenderReport& report, const Scene& scene) {
    if (report.tallies.overlaps == 0)
        return;
    report.warnings.push_back(overlapText(scene, report.tallies));
    spdlog::warn("{}", report.warnings.back());
}

void printSummary(const RenderReport& report) {
    fmt::print(
        "{}: {}x{}, {} samples per pixel in {:.2f} s on {} ({:.2f} M samples/s, {:.2f} M rays/s), bias "
        "ledger: {}\n",
        report.scene, report.settings.image.width, report.settings.image.height,
        report.samples / (uint64_t{report.settings.image.width} * report.settings.image.height),
        report.renderSeconds, report.device.name,
        static_cast<double>(report.samples) / report.renderSeconds * 1e-6,
        static_cast<double>(report.rays.total()) / report.renderSeconds * 1e-6, ledgerText(report.ledger));
    std::fflush(stdout); // who watches wants to know now
}

} // namespace

RenderCommand::RenderCommand(CLI::App& app)
    : Command(app, "render", "Render a scene to an image"), options_(parser()), sceneOptions_(parser()),
      sequence_(parser()), shaders_(parser()), tone_(parser()), checkpoints_(parser()) {
    shaders_.declareWatch(parser());
    parser()
        .add_option("scene", scene_,
                    "Built-in scene (" + fmt::format("{}", fmt::join(builtinNames(), ", ")) +
                        ") or .gltf or .glb file")
        ->type_name("SCENE");
    parser()
        .add_option("-o,--output", outputs_.exr, "EXR file; default: the scene's name, unless --png is given")
        ->type_name("OUT.exr");
    parser().add_option("--png", outputs_.png, "PNG file to look at (sRGB)")->type_name("OUT.png");
    parser()
        .add_option("--report", outputs_.report, "JSON report: times, rays, memory, ledger")
        ->type_name("REPORT.json");
    parser().add_flag("--quiet", quiet_, "No messages but errors, no summary");
}

// What lasts from one frame to the next: kernels are compiled again only where a frame's features differ.
struct RenderCommand::Session {
    RenderSettings settings;
    ToneSettings tone;
    Checkpoint checkpoint{{}, {}};
    KernelSource source = embeddedKernel;
    std::optional<gpu::Device> device{};
    std::optional<EstimatorKernels> kernels{};
    std::optional<ToneMapper> toneMapper{}; // where there is a PNG to write
    std::optional<Camera> standIn{};        // of the first frame: its scene moves, the picture must not

    // The camera of a frame; the first one also says what is wrong with the scene, and the image's size.
    [[nodiscard]] Camera view(const Scene& scene, const RenderOptions& options) {
        if (!device) {
            for (const std::string& warning : scene.warnings)
                spdlog::warn("{}", warning);
            if (!scene.hasOwnCamera)
                standIn = options.cameraOf(scene);
        }
        const Camera camera = standIn ? *standIn : options.cameraOf(scene);
        settings = resolveSize(settings, camera);
        checkSettings(settings);
        return camera;
    }

    // The kernels of the frame before serve, if they do.
    [[nodiscard]] std::unique_ptr<Renderer> makeRenderer(const Scene& scene, const Camera& camera) {
        if (!kernels)
            return std::make_unique<Renderer>(*device, scene, camera, settings, source);
        EstimatorKernels earlier = std::move(*kernels);
        kernels.reset();
        return std::make_unique<Renderer>(*device, scene, camera, settings, std::move(earlier), source);
    }

    // Shaders as they are now, for the kernels to come and for the record.
    void use(const std::shared_ptr<ShaderOverlay>& overlay) {
        settings.provenance.changedShaders = overlay->changed();
        source = sourceOf(overlay);
    }
};

void RenderCommand::requireOutputs(const Outputs& outputs) const {
    const std::array<std::string, 4> files{outputs.exr, outputs.png, outputs.report, outputs.checkpoint};
    for (auto file = files.begin(); file != files.end(); ++file) {
        if (file->empty())
            continue;
        if (std::find(files.begin(), file, *file) != file)
            throw UsageError(fmt::format("{} cannot hold two outputs: give each a file of its own", *file));
        requireWritable(*file);
    }
}

int RenderCommand::run() {
    if (quiet_)
        configureLog(LogLevel::quiet);
    if (outputs_.exr.empty() && outputs_.png.empty())
        outputs_.exr = std::filesystem::path(scene_).stem().string() + ".exr";
    const ToneSettings tone = tone_.settings();
    if (tone_.isGiven() && outputs_.png.empty())
        throw UsageError("--tonemap and --exposure are for a PNG; give --png OUT.png, or leave them out");
    Session session{options_.settings(), tone};
    outputs_.checkpoint = checkpoints_.file(session.settings);
    if (const auto overlay = shaders_.overlay())
        session.use(overlay);
    if (sequence_.isAsked() && shaders_.isWatching())
        throw UsageError("--watch renders one image over and over, --frames several: give one of them");
    if (sequence_.isAsked())
        return runSequence(session);
    requireOutputs(outputs_);
    session.checkpoint = Checkpoint(outputs_.checkpoint, checkpoints_.interval());
    return shaders_.isWatching() ? runWatching(session)
                                 : renderMoment(outputs_, sceneOptions_.importOptions(), session);
}

int RenderCommand::runSequence(Session& session) const {
    const FrameRange range = sequence_.range();
    for (uint32_t frame = range.first; frame < range.end; ++frame) {
        const Outputs files{numberedFile(outputs_.exr, frame),
                            numberedFile(outputs_.png, frame),
                            numberedFile(outputs_.report, frame),
                            {}};
        requireOutputs(files);
        const ImportOptions moment = sceneOptions_.importOptionsAt(sequence_.secondsOf(frame));
        if (const int code = renderMoment(files, moment, session); code != 0)
            return code;
    }
    return 0;
}

// Until Ctrl-C. A save that changes a kernel ends the render that is under way; any other leaves it alone.
int RenderCommand::runWatching(Session& session) const {
    FileWatch saves(shaders_.folder());
    Take take = prepare(sceneOptions_.importOptions(), session);
    const InterruptGuard guard;
    const ToneMapper* toneMapper = session.toneMapper ? &*session.toneMapper : nullptr;
    std::shared_ptr<ShaderOverlay> next;
    const auto look = [&](std::chrono::milliseconds atMost) {
        const std::vector<std::string> changes = saves.wait(atMost);
        next = changes.empty() ? nullptr : shaders_.reread(changes, *take.renderer, toneMapper);
    };
    while (!guard.interrupted()) {
        takeSamples(take, [&] {
            look(std::chrono::milliseconds(0));
            return !next && !guard.interrupted();
        });
        if (!next)
            write(take, outputs_, session);
        while (!next && !guard.interrupted())
            look(std::chrono::hours(1));
        if (next) {
            take.watch = Stopwatch();
            session.use(next);
            take.renderer->reloadKernels(session.source);
            if (session.toneMapper)
                session.toneMapper.emplace(*session.device, session.source);
            spdlog::info("compiled in {:.2f} s", take.watch.lap("prepare"));
        }
    }
    return guard.exitCode();
}

Take RenderCommand::prepare(const ImportOptions& moment, Session& session) const {
    Take take;
    take.scene = loadLit(scene_, moment, session.settings.lighting);
    take.report.import = moment;
    const Camera camera = session.view(take.scene, options_);
    take.report.camera = camera.name;
    take.watch.lap("load");
    if (!session.device)
        session.device.emplace(options_.device());
    take.watch.lap("device");
    take.renderer = session.makeRenderer(take.scene, camera);
    if (!outputs_.png.empty() && !session.toneMapper)
        session.toneMapper.emplace(*session.device, session.source);
    take.watch.lap("prepare");
    return take;
}

void RenderCommand::takeSamples(Take& take, const std::function<bool()>& mayGoOn) const {
    ProgressBar progress(!quiet_);
    take.takeSamples([&](double fraction) {
        progress.show(fraction);
        return mayGoOn();
    });
}

void RenderCommand::write(Take& take, const Outputs& files, Session& session) const {
    session.device->requireNoValidationMessages();
    RenderReport& report = take.report;
    take.describeInputs(*session.device, session.settings.provenance.changedShaders);
    const Rendering rendering = take.renderer->rendering();
    fillResults(report, *take.renderer, *session.device, rendering, take.scene);
    warnOfOverlaps(report, take.scene);
    report.rays = report.rays + take.before.rays;
    if (!files.exr.empty() && options_.keepsFilm())
        writeFilmFile(files.exr, take.film());
    else if (!files.exr.empty())
        writeExr(files.exr, rendering, exrMetadata(report));
    if (!files.png.empty()) {
        report.tone = session.tone;
        writePng(files.png, report.settings.image.width, report.settings.image.height,
                 session.toneMapper->map(take.renderer->film(), session.tone));
    }
    take.watch.lap("write");
    report.stages = take.watch.stages();
    report.stages.emplace_back("prepareBvh", take.renderer->scene().bvhSeconds());
    report.stages.emplace_back("prepareKernels", take.renderer->kernels().seconds());
    if (take.toFirstSamples)
        report.stages.emplace_back("processToFirstSamples", *take.toFirstSamples);
    if (!files.report.empty())
        writeFileAtomically(files.report, reportJson(report));
    if (!quiet_)
        printSummary(report);
}

int RenderCommand::renderMoment(const Outputs& files, const ImportOptions& moment, Session& session) const {
    Take take = prepare(moment, session);
    const InterruptGuard guard; // until all files are written: Ctrl-C loses no image
    Checkpoint& checkpoint = session.checkpoint;
    take.describeInputs(*session.device, session.settings.provenance.changedShaders);
    if (checkpoints_.isResuming())
        take.resumeFrom(checkpoint);
    takeSamples(take, [&] {
        if (checkpoint.isDue())
            take.keep(checkpoint);
        return !guard.interrupted();
    });
    if (checkpoint.isWanted())
        checkpoint.write([&] { return take.film(); });
    write(take, files, session);
    checkpoint.requireWritten();
    session.kernels = take.renderer->releaseKernels();
    return take.report.stop == StopReason::interrupted ? guard.exitCode() : 0;
}

} // namespace lavalight
