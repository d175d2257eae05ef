#include "session/render_session.h"

#include <utility>

#include <fmt/format.h>

#include "base/log.h"
#include "hosted/host_rays.h"
#include "image/png.h"
#include "render/schedule_choice.h"
#include "scene/clipping.h"
#include "scene/ground.h"
#include "scene/view_extent.h"
#include "scene/world_position.h"
#include "session/builtin.h"
#include "session/lit_scene.h"
#include "session/next_frame.h"

namespace lavalight {
namespace {

void warnOfFarPlane(PreparedScene& prepared) {
    const ImageSettings& image = prepared.settings.image;
    const ViewExtent view =
        viewExtent(prepared.camera, static_cast<float>(image.width), static_cast<float>(image.height));
    const uint64_t hidden = trianglesBeyondFar(prepared.scene, prepared.camera, view);
    if (hidden > 0)
        prepared.scene.warnings.push_back(fmt::format(
            "camera \"{}\" ends at its zfar of {:g} m, which hides {} triangles or parts of them: "
            "--no-clip shows them",
            prepared.camera.name, prepared.camera.zfar, hidden));
}

// Width over height; where the camera decides the width, as resolveSize() has it.
float aspectOf(const ImageSettings& image) {
    constexpr float kDefault = 16.0f / 9.0f;
    return image.width > 0 ? static_cast<float>(image.width) / static_cast<float>(image.height) : kDefault;
}

PreparedScene complete(Scene scene, const Camera& camera, const RenderSettings& settings,
                       double groundHeight) {
    PreparedScene prepared{std::move(scene), camera, resolveSize(settings, camera)};
    checkSettings(prepared.settings);
    warnOfFarPlane(prepared);
    layGround(prepared.settings.ground, groundHeight, prepared.scene);
    return prepared;
}

Scene loadScene(const RenderPlan& plan, const ImportOptions& moment) {
    if (plan.loaded)
        return *plan.loaded;
    return loadLitScene(plan.scene, seenFrom(plan.camera, moment), plan.settings.lighting);
}

// What a file's author meant is kept, dark surroundings included: somebody who wonders is told of the way
// out.
void logNotes(const Scene& scene, const RenderPlan& plan) {
    for (const std::string& warning : scene.warnings)
        spdlog::warn("{}", warning);
    if (scene.hasOwnLight && !bringsLight(plan.settings.lighting) && !isBuiltin(plan.scene))
        spdlog::info("the scene's own light is the only one; --env studio adds light from all sides");
}

} // namespace

PreparedScene prepareScene(const RenderPlan& plan, const ImportOptions& moment) {
    Scene scene = loadScene(plan, moment);
    const Camera camera = chooseCamera(scene, plan.camera, aspectOf(plan.settings.image));
    const double ground = groundHeightOf(scene);
    PreparedScene prepared = complete(std::move(scene), camera, plan.settings, ground);
    logNotes(prepared.scene, plan);
    return prepared;
}

void RenderSession::use(const std::shared_ptr<ShaderOverlay>& overlay) {
    plan_.settings.provenance.changedShaders = overlay ? overlay->changed() : std::vector<std::string>();
    source_ = sourceOf(overlay);
    isToldWhatTraces_ = false;
}

void RenderSession::use(RenderSettings settings) {
    settings.provenance.changedShaders = std::move(plan_.settings.provenance.changedShaders);
    plan_.settings = std::move(settings);
}

void RenderSession::use(RenderPlan plan) {
    plan.settings.provenance.changedShaders = std::move(plan_.settings.provenance.changedShaders);
    plan_ = std::move(plan);
    standIn_.reset();
    groundHeight_.reset();
    isWarned_ = false;
}

// The camera that stands in, if there is one; each moment has an origin of its own.
Camera RenderSession::cameraOf(const Scene& scene, const CameraChoice& choice) const {
    if (!standIn_)
        return chooseCamera(scene, choice, aspectOf(plan_.settings.image));
    Camera camera = *standIn_;
    camera.position = fromWorld(toWorld(camera.position, standInOrigin_), scene.origin);
    return camera;
}

void RenderSession::loadNext(Scene& scene, const NextMoment& next) const {
    Scene later = next.loaded ? *next.loaded : loadScene(plan_, next.moment);
    CameraChoice choice = plan_.camera;
    choice.turns = next.turns;
    const Camera camera = cameraOf(later, choice);
    if (plan_.settings.ground.kind == Ground::lambert)
        copyGround(scene, later);
    scene.next = nextFrameOf(scene, later, camera);
}

// The first scene of an animation speaks for all: its warnings, its stand-in camera, its ground, its image's
// size.
PreparedScene RenderSession::load(const ImportOptions& moment) {
    Scene scene = loadScene(plan_, moment);
    const bool frames = plan_.camera.view != NamedView::none || !scene.hasOwnCamera;
    const Camera camera = cameraOf(scene, plan_.camera);
    if (frames && !plan_.camera.turns) {
        standIn_ = camera;
        standInOrigin_ = scene.origin;
    }
    if (!groundHeight_)
        groundHeight_ = groundHeightOf(scene);
    PreparedScene prepared = complete(std::move(scene), camera, plan_.settings, *groundHeight_);
    if (!std::exchange(isWarned_, true))
        logNotes(prepared.scene, plan_);
    plan_.settings = prepared.settings;
    return prepared;
}

void RenderSession::follow(const ImportOptions& first, std::shared_ptr<const Scene> loaded) {
    (void)load(first);
    plan_.loaded = std::move(loaded);
}

std::unique_ptr<Renderer> RenderSession::makeRenderer(const PreparedScene& prepared) {
    if (!kernels_)
        return std::make_unique<Renderer>(*device_, prepared.scene, prepared.camera, prepared.settings,
                                          source_);
    EstimatorKernels earlier = std::move(*kernels_);
    kernels_.reset();
    return std::make_unique<Renderer>(*device_, prepared.scene, prepared.camera, prepared.settings,
                                      std::move(earlier), source_);
}

void RenderSession::sayWhatTraces() {
    const std::string why = whyNotHosted(plan_.settings, device_->description(), source_);
    if (!std::exchange(isToldWhatTraces_, true) && !why.empty())
        spdlog::info("{}", why);
}

std::vector<std::string> RenderSession::changedKernels(const RenderJob& job,
                                                       const KernelSource& source) const {
    std::vector<std::string> names = job.renderer->changedKernels(source);
    if (!job.renderer->keepsAccelerator(plan_.settings, source))
        names.insert(names.end(), kTracingKernels.begin(), kTracingKernels.end());
    if (toneMapper_ && toneMapper_->isChanged(source))
        names.emplace_back("tonemap");
    return names;
}

RenderJob RenderSession::prepare(const ImportOptions& moment, const Outputs& outputs,
                                 const std::optional<NextMoment>& next) {
    RenderJob job;
    PreparedScene prepared = load(moment);
    if (next && (plan_.settings.layers >> kMotionPlane & 1u) != 0)
        loadNext(prepared.scene, *next);
    job.writesExr = !outputs.exr.empty();
    job.report.import = moment;
    job.report.camera = prepared.camera.name;
    job.watch.lap("load");
    if (device_ == nullptr)
        device_ = &ownDevice_.emplace(plan_.device);
    job.device = device_;
    job.watch.lap("device");
    job.renderer = makeRenderer(prepared);
    sayWhatTraces();
    job.camera = prepared.camera;
    if (!outputs.png.empty() && !toneMapper_)
        toneMapper_.emplace(*device_, source_);
    job.scene = std::move(prepared.scene);
    job.watch.lap("prepare");
    return job;
}

void RenderSession::reload(RenderJob& job) {
    job.watch = Stopwatch();
    std::optional<ToneMapper> toneMapper;
    if (toneMapper_)
        toneMapper.emplace(*device_, source_);
    if (job.renderer->keepsAccelerator(plan_.settings, source_)) {
        job.renderer->reloadKernels(source_);
    } else {
        job.renderer = std::make_unique<Renderer>(*device_, job.scene, job.camera, plan_.settings, source_);
        sayWhatTraces();
    }
    toneMapper_ = std::move(toneMapper);
    job.watch.lap("prepare");
}

void RenderSession::restart(RenderJob& job, const SampleRange& samples) {
    job.watch = Stopwatch();
    plan_.settings.image.firstSample = samples.first;
    plan_.settings.stop.samples = samples.end - samples.first;
    checkSettings(plan_.settings);
    job.renderer->restart(job.scene, job.camera, plan_.settings, source_);
    job.before = {};
    job.watch.lap("prepare");
}

void RenderSession::render(RenderJob& job, Checkpoint& checkpoint, bool resumes,
                           const RenderJob::KeepGoing& keepGoing) {
    job.describeInputs(plan_.settings.provenance.changedShaders);
    if (resumes)
        job.resumeFrom(checkpoint);
    job.takeSamples([&](double fraction) {
        if (checkpoint.isDue())
            job.keep(checkpoint);
        return keepGoing(fraction);
    });
    if (checkpoint.isWanted())
        checkpoint.write([&] { return job.film(); });
}

FinishedImage RenderSession::image(RenderJob& job) {
    device_->requireNoValidationMessages();
    job.describeInputs(plan_.settings.provenance.changedShaders);
    return finishImage(job, plan_.style, toneMapper_ ? &*toneMapper_ : nullptr);
}

void RenderSession::write(RenderJob& job, const Outputs& outputs) {
    device_->requireNoValidationMessages();
    job.describeInputs(plan_.settings.provenance.changedShaders);
    writeOutputs(job, outputs, plan_.style, toneMapper_ ? &*toneMapper_ : nullptr);
}

} // namespace lavalight
