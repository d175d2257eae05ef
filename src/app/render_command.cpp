#include "app/render_command.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/interrupt.h"
#include "app/progress.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/process_time.h"
#include "image/exr.h"
#include "image/png.h"
#include "render/renderer.h"
#include "render/report.h"
#include "scene/builtin.h"

namespace lavalight {
namespace {

constexpr int kInterrupted = 130;

// Splits the time of a run into named stages.
class Stopwatch {
  public:
    // Seconds since the last call, kept under that name.
    double lap(const std::string& stage) {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        stages_.emplace_back(stage, seconds);
        return seconds;
    }
    [[nodiscard]] const StageTimes& stages() const { return stages_; }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    StageTimes stages_;
};

glm::dvec3 meanOf(const Image& image) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& pixel : image.pixels)
        sum += glm::dvec3(pixel);
    return sum / static_cast<double>(image.pixels.size());
}

uint64_t totalOf(const std::vector<uint32_t>& counts) {
    uint64_t total = 0;
    for (const uint32_t count : counts)
        total += count;
    return total;
}

void failOnValidation(const gpu::Device& device) {
    const std::vector<std::string> messages = device.validationMessages();
    if (!messages.empty())
        throw Error(fmt::format("the validation layer has {} messages, the first: {}", messages.size(),
                                messages.front()));
}

Scene loadWithWarnings(const std::string& name, const ImportOptions& options) {
    Scene scene = loadScene(name, options);
    for (const std::string& warning : scene.warnings)
        spdlog::warn("{}", warning);
    return scene;
}

struct RenderRun {
    StopReason stop = StopReason::samples;
    std::optional<double>
        toFirstSamples; // seconds from the start of the process to the end of the first wave
};

RenderRun renderInterruptibly(Renderer& renderer, const InterruptGuard& guard, bool showProgress) {
    ProgressBar progress(showProgress);
    RenderRun run;
    run.stop = renderer.render([&](double fraction) {
        if (!run.toFirstSamples)
            run.toFirstSamples = secondsSinceProcessStart();
        progress.show(fraction);
        return !guard.interrupted();
    });
    return run;
}

void fillInputs(RenderReport& report, const Scene& scene, const Camera& camera,
                const RenderSettings& settings) {
    report.camera = camera.name;
    report.settings = settings;
    report.scene = scene.source;
    report.triangles = scene.triangleCount();
    report.warnings = scene.warnings;
}

void fillResults(RenderReport& report, const Renderer& renderer, const gpu::Device& device,
                 const Rendering& rendering) {
    report.device = device.description();
    report.kernels = renderer.waves().kernelTimes();
    report.rays = renderer.waves().rays();
    report.tallies = renderer.film().readTallies();
    report.sceneBytes = renderer.scene().bytes();
    report.peakDeviceBytes = device.peakAllocatedBytes();
    report.samples = totalOf(rendering.sampleCounts);
    report.meanRadiance = meanOf(rendering.radiance);
    const glm::dvec3 variance = meanOf(rendering.variance);
    report.meanVariance = (variance.x + variance.y + variance.z) / 3.0;
    report.errorEstimate = errorEstimate(rendering);
}

void printSummary(const RenderReport& report) {
    fmt::print(
        "{}: {}x{}, {} samples per pixel in {:.2f} s on {} ({:.2f} M samples/s, {:.2f} M rays/s), bias "
        "ledger: {}\n",
        report.scene, report.settings.width, report.settings.height,
        report.samples / (uint64_t{report.settings.width} * report.settings.height), report.renderSeconds,
        report.device.name, static_cast<double>(report.samples) / report.renderSeconds * 1e-6,
        static_cast<double>(report.rays.total()) / report.renderSeconds * 1e-6, ledgerText(report.ledger));
}

} // namespace

RenderCommand::RenderCommand(CLI::App& app)
    : Command(app, "render", "Render a scene to an image"), options_(parser()), sceneOptions_(parser()) {
    parser()
        .add_option("scene", scene_,
                    "Built-in scene (" + fmt::format("{}", fmt::join(builtinNames(), ", ")) +
                        ") or .gltf or .glb file")
        ->type_name("SCENE");
    parser()
        .add_option("-o,--output", exr_, "EXR file; default: the scene's name, unless --png is given")
        ->type_name("OUT.exr");
    parser().add_option("--png", png_, "PNG file to look at (sRGB)")->type_name("OUT.png");
    parser().add_option("--exposure", exposure_, "Stops of exposure for the PNG")->type_name("STOPS");
    parser()
        .add_option("--report", report_, "JSON report: times, rays, memory, ledger")
        ->type_name("REPORT.json");
    parser().add_flag("--quiet", quiet_, "No messages but errors, no summary");
}

void RenderCommand::requireOutputs() const {
    if (!std::isfinite(exposure_))
        throw UsageError(fmt::format("--exposure: {} is no number of stops", exposure_));
    const std::array<std::string, 3> files{exr_, png_, report_};
    for (auto file = files.begin(); file != files.end(); ++file) {
        if (file->empty())
            continue;
        if (std::find(files.begin(), file, *file) != file)
            throw UsageError(fmt::format("{} cannot hold two outputs: give each a file of its own", *file));
        requireWritable(*file);
    }
}

void RenderCommand::writeImages(const Rendering& rendering, const RenderReport& report) const {
    if (!exr_.empty())
        writeExr(exr_, rendering, exrMetadata(report));
    if (!png_.empty())
        writePng(png_, rendering.radiance, exposure_);
}

int RenderCommand::run() {
    if (quiet_)
        configureLog(LogLevel::quiet);
    if (exr_.empty() && png_.empty())
        exr_ = std::filesystem::path(scene_).stem().string() + ".exr";
    RenderSettings settings = options_.settings();
    requireOutputs();

    RenderReport report;
    Stopwatch watch;
    report.import = sceneOptions_.importOptions();
    const Scene scene = loadWithWarnings(scene_, report.import);
    const Camera& camera = options_.pickCamera(scene);
    settings = resolveSize(settings, camera);
    checkSettings(settings);
    watch.lap("load");

    gpu::Device device(options_.device());
    watch.lap("device");
    Renderer renderer(device, scene, camera, settings);
    watch.lap("prepare");

    const InterruptGuard guard; // until all files are written: Ctrl-C loses no image
    const RenderRun run = renderInterruptibly(renderer, guard, !quiet_);
    report.stop = run.stop;
    report.renderSeconds = watch.lap("render");
    failOnValidation(device);

    const Rendering rendering = renderer.rendering();
    fillInputs(report, scene, camera, renderer.settings());
    fillResults(report, renderer, device, rendering);
    report.ledger = makeLedger(scene, settings, report.tallies, report.stop);
    writeImages(rendering, report);
    watch.lap("write");
    report.stages = watch.stages();
    report.stages.emplace_back("prepareBvh", renderer.scene().bvhSeconds());
    report.stages.emplace_back("prepareKernels", renderer.kernels().seconds());
    if (run.toFirstSamples)
        report.stages.emplace_back("processToFirstSamples", *run.toFirstSamples);
    if (!report_.empty())
        writeFileAtomically(report_, reportJson(report));
    if (!quiet_)
        printSummary(report);
    return report.stop == StopReason::interrupted ? kInterrupted : 0;
}

} // namespace lavalight
