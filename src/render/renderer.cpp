#include "render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "device_scene/scene_features.h"
#include "device_scene/triangle_layers.h"
#include "hosted/host_rays.h"
#include "render/schedule_choice.h"
#include "render/wave_budget.h"

namespace lavalight {
namespace {

// Constant radiance, or what the map's texels are multiplied by.
glm::vec3 environmentFactor(const Scene& scene, const RenderSettings& settings) {
    const glm::vec3 unscaled =
        scene.environmentMap ? glm::vec3(1.0f) : settings.lighting.constant.value_or(scene.environment);
    return settings.lighting.intensity * unscaled;
}

bool isTimed(const StopRule& stop) {
    return stop.seconds > 0.0;
}

WaveWalk walkThrough(const RenderSettings& settings, const Film& film) {
    WaveLimits limits;
    for (const FilmBand& band : film.bands())
        limits.bandPixels.push_back(band.rows * film.width());
    limits.planes = static_cast<uint32_t>(film.layout().planes().size());
    limits.waveSize = settings.work.waveSize;
    limits.mayStop = settings.stop.isProgressive || isTimed(settings.stop) || settings.stop.targetError > 0.0;
    return {phasesOf(settings), std::move(limits)};
}

// For layers that ask for it; else nothing.
gpu::Buffer makeTriangleLayers(gpu::Device& device, const Scene& scene, const RenderSettings& settings) {
    const bool isAsked = (settings.layers & (1u << kUvPlane | 1u << kMotionPlane)) != 0;
    const std::vector<TriangleLayers> layers =
        isAsked ? triangleLayers(scene) : std::vector<TriangleLayers>();
    gpu::Buffer buffer(device, "layers of triangles", layers.size() * sizeof(TriangleLayers),
                       gpu::BufferUse::storage);
    if (!layers.empty())
        buffer.upload(std::span<const TriangleLayers>(layers));
    return buffer;
}

SurfaceIds makeSurfaceIds(const Scene& scene, const RenderSettings& settings) {
    return layoutOf(filmPlanes(settings)).idLayers().empty() ? SurfaceIds() : surfaceIds(scene);
}

Film makeFilm(gpu::Device& device, const RenderSettings& settings) {
    const PixelWindow window = windowOf(settings.image);
    return {device, window.width, window.height, settings.work.bandRows, layoutOf(filmPlanes(settings))};
}

std::vector<KernelVariant> variantsFor(const RenderSettings& settings, const MaterialClasses& classes) {
    return kernelVariants(phasesOf(settings), settings.work.schedule, classes,
                          kernelAccelerator(acceleratorOf(settings)));
}

} // namespace

RenderSettings resolveSize(RenderSettings settings, const Camera& camera) {
    if (settings.image.width == 0) {
        const float aspect = camera.aspect.value_or(16.0f / 9.0f);
        const float width = std::round(static_cast<float>(settings.image.height) * aspect);
        settings.image.width =
            static_cast<uint32_t>(std::clamp(width, 1.0f, static_cast<float>(kMaxImageSide)));
    }
    return settings;
}

namespace {

// What camera and background add to the features of the scene.
SceneFeatures viewFeatures(const Camera& camera, const FrameParameters& frame) {
    return cameraFeatures(camera) | (frame.startsVary != 0 ? kFeatureStartsVary : 0u) |
           (frame.hasBackground != 0 ? kFeatureBackground : 0u) |
           (frame.catchesShadows != 0 ? kFeatureShadowCatcher : 0u) |
           (frame.hasLayers != 0 ? kFeatureLayers : 0u) | (frame.hasFilter != 0 ? kFeatureFilter : 0u) |
           (frame.cropStart != 0 || frame.cropWidth != frame.imageWidth ? kFeatureCrop : 0u);
}

} // namespace

bool keepsLights(const RenderSettings& a, const RenderSettings& b) {
    return a.estimator.lightSelection == b.estimator.lightSelection &&
           (a.estimator.mis == Mis::off) == (b.estimator.mis == Mis::off) &&
           a.lighting.constant == b.lighting.constant && a.lighting.mapFile == b.lighting.mapFile &&
           a.lighting.procedural == b.lighting.procedural && a.lighting.sky == b.lighting.sky &&
           a.lighting.intensity == b.lighting.intensity;
}

// The slow work before a render can start: the BVH is built on the host while the driver compiles the
// kernels.
struct Renderer::Setup {
    FrameParameters frame;
    SceneFeatures features; // with the camera's
    MaterialClasses classes;
    EstimatorKernels kernels;
    SceneData scene;
    LightSelection lightSelection;
    gpu::Buffer triangleLayers;
    SurfaceIds surfaceIds;

    using MakeKernels =
        std::function<EstimatorKernels(SceneFeatures features, const MaterialClasses& classes)>;

    static Setup make(gpu::Device& device, const Scene& scene, const Camera& camera,
                      const RenderSettings& settings, const MakeKernels& makeKernels) {
        const EstimatorSettings& estimator = settings.estimator;
        const Lights lights = collectLights(scene, environmentFactor(scene, settings),
                                            estimator.lightSelection, estimator.mis != Mis::off);
        std::future<SceneData> packed =
            std::async(std::launch::async, [&] { return packScene(scene, lights, acceleratorOf(settings)); });
        FrameParameters frame = makeFrame(scene, camera, settings);
        setLights(frame, lights);
        const SceneFeatures features = sceneFeatures(scene, lights) | viewFeatures(camera, frame);
        MaterialClasses classes = materialClasses(scene);
        EstimatorKernels kernels = makeKernels(features, classes);
        return {frame,
                features,
                std::move(classes),
                std::move(kernels),
                packed.get(),
                lights.selection,
                makeTriangleLayers(device, scene, settings),
                makeSurfaceIds(scene, settings)};
    }
};

// The parts that restart() makes, built beside those that they replace.
struct Renderer::Fresh {
    RenderSettings settings;
    FrameParameters frame;
    SceneFeatures features;                    // with the camera's
    std::optional<EstimatorKernels> kernels{}; // none: the present ones serve, but for `changed`
    KernelMap changed{};
    std::optional<AlbedoTable> albedoTable{};    // none: the present one serves
    std::optional<Film> film{};                  // none: the present one serves, emptied
    std::optional<gpu::Buffer> triangleLayers{}; // none: the present ones serve, as the next
    std::optional<SurfaceIds> surfaceIds{};
};

Renderer::Renderer(gpu::Device& device, const Scene& scene, const Camera& camera,
                   const RenderSettings& wanted, const KernelSource& source)
    : Renderer(
          device, resolveSchedule(wanted, device.description(), source),
          [&](const RenderSettings& settings) {
              const auto make = [&](SceneFeatures features, const MaterialClasses& classes) {
                  return EstimatorKernels(device, variantsFor(settings, classes), settings.estimator,
                                          features, filmPlanes(settings), source);
              };
              return Setup::make(device, scene, camera, settings, make);
          },
          source) {}

Renderer::Renderer(gpu::Device& device, const Scene& scene, const Camera& camera,
                   const RenderSettings& wanted, EstimatorKernels earlier, const KernelSource& source)
    : Renderer(
          device, resolveSchedule(wanted, device.description(), source),
          [&](const RenderSettings& settings) {
              const auto make = [&](SceneFeatures features, const MaterialClasses& classes) {
                  std::vector<KernelVariant> variants = variantsFor(settings, classes);
                  const uint32_t planes = filmPlanes(settings);
                  if (earlier.serve(variants, settings.estimator, features, planes))
                      return std::move(earlier);
                  return EstimatorKernels(device, std::move(variants), settings.estimator, features, planes,
                                          source);
              };
              return Setup::make(device, scene, camera, settings, make);
          },
          source) {}

Renderer::Renderer(gpu::Device& device, const RenderSettings& settings,
                   const std::function<Setup(const RenderSettings&)>& setUp, const KernelSource& source)
    : Renderer(device, settings, setUp(settings), source) {}

Renderer::Renderer(gpu::Device& device, const RenderSettings& settings, Setup setup,
                   const KernelSource& source)
    : device_(&device), settings_(settings), frame_(setup.frame), sceneFeatures_(setup.scene.features),
      features_(setup.features), classes_(std::move(setup.classes)), kernels_(std::move(setup.kernels)),
      scene_(device, setup.scene, source), film_(makeFilm(device, settings)),
      triangleLayers_(std::move(setup.triangleLayers)), surfaceIds_(std::move(setup.surfaceIds)),
      walk_(walkThrough(settings, film_)), waves_(makeWaves(Fresh{settings_, frame_, features_})) {
    settings_.estimator.lightSelection = setup.lightSelection;
}

bool Renderer::wantsAlbedoTable(const KernelSource& source) const {
    const std::string& content = scene_.albedoTable().kernelContent;
    return !content.empty() && source("albedo").content != content;
}

bool Renderer::keepsAccelerator(const RenderSettings& wanted, const KernelSource& source) const {
    return acceleratorOf(resolveSchedule(wanted, device_->description(), source)) == acceleratorOf(settings_);
}

std::vector<std::string> Renderer::changedKernels(const KernelSource& source) const {
    std::vector<std::string> names = kernels_.changed(source);
    if (wantsAlbedoTable(source))
        names.emplace_back("albedo");
    return names;
}

void Renderer::compileChanged(Fresh& fresh, const KernelSource& source) const {
    if (!fresh.kernels)
        fresh.changed = kernels_.compileChanged(*device_, source);
    if (wantsAlbedoTable(source))
        fresh.albedoTable = makeAlbedoTable(*device_, source("albedo"));
}

void Renderer::reloadKernels(const KernelSource& source) {
    Fresh fresh{settings_, frame_, features_};
    compileChanged(fresh, source);
    startAnew(std::move(fresh));
}

void Renderer::restart(const Scene& scene, const Camera& camera, const RenderSettings& wanted,
                       const KernelSource& source) {
    Fresh fresh{resolveSchedule(wanted, device_->description(), source), {}, 0};
    fresh.settings.estimator.lightSelection = settings_.estimator.lightSelection;
    fresh.frame = makeFrame(scene, camera, fresh.settings);
    copyLights(frame_, scene, fresh.frame);
    fresh.features = sceneFeatures_ | viewFeatures(camera, fresh.frame);
    const EstimatorSettings& estimator = fresh.settings.estimator;
    std::vector<KernelVariant> variants = variantsFor(fresh.settings, classes_);
    const uint32_t planes = filmPlanes(fresh.settings);
    if (!kernels_.serve(variants, estimator, fresh.features, planes))
        fresh.kernels.emplace(*device_, std::move(variants), estimator, fresh.features, planes, source);
    compileChanged(fresh, source);
    const PixelWindow window = windowOf(fresh.settings.image);
    if (window.width != film_.width() || window.height != film_.height() || planes != filmPlanes(settings_))
        fresh.film.emplace(makeFilm(*device_, fresh.settings));
    if (planes != filmPlanes(settings_)) {
        fresh.triangleLayers.emplace(makeTriangleLayers(*device_, scene, fresh.settings));
        fresh.surfaceIds.emplace(makeSurfaceIds(scene, fresh.settings));
    }
    startAnew(std::move(fresh));
}

// Waves bound to the fresh parts, and to the present ones where nothing is fresh.
std::unique_ptr<WaveRenderer> Renderer::makeWaves(const Fresh& fresh) const {
    const std::vector<Phase> phases = phasesOf(fresh.settings);
    const auto kernel = [&](std::string_view name) -> const gpu::Kernel& {
        const auto found = fresh.changed.find(name);
        return found != fresh.changed.end() ? found->second
                                            : (fresh.kernels ? *fresh.kernels : kernels_)[name];
    };
    const AlbedoTable& albedo = fresh.albedoTable ? *fresh.albedoTable : scene_.albedoTable();
    const Film& film = fresh.film ? *fresh.film : film_;
    const gpu::Buffer& triangles = fresh.triangleLayers ? *fresh.triangleLayers : triangleLayers_;
    return makeWaveRenderer(*device_, {phases, fresh.settings.work.schedule, scene_, albedo.buffer, triangles,
                                       film, fresh.frame, kernel, classes_, fresh.features});
}

// Everything that may fail comes first; what is bound to kernels and film goes before them.
void Renderer::startAnew(Fresh fresh) {
    std::unique_ptr<WaveRenderer> waves = makeWaves(fresh);
    WaveWalk walk = walkThrough(fresh.settings, fresh.film ? *fresh.film : film_);
    if (!fresh.film)
        emptyFilm();
    waves_ = std::move(waves);
    if (fresh.kernels)
        kernels_ = std::move(*fresh.kernels);
    kernels_.replace(std::move(fresh.changed));
    if (fresh.albedoTable)
        scene_.setAlbedoTable(std::move(*fresh.albedoTable));
    if (fresh.film)
        film_ = std::move(*fresh.film);
    if (fresh.triangleLayers)
        triangleLayers_ = std::move(*fresh.triangleLayers);
    if (fresh.surfaceIds)
        surfaceIds_ = std::move(*fresh.surfaceIds);
    filmIsEmptied_ = true;
    settings_ = fresh.settings;
    frame_ = fresh.frame;
    features_ = fresh.features;
    walk_ = std::move(walk);
}

// A failure here leaves the film emptied, or not.
void Renderer::emptyFilm() {
    filmIsEmptied_ = false;
    walk_.startAgain();
    film_.clear();
    filmIsEmptied_ = true;
}

StopReason Renderer::render(const KeepGoing& keepGoing) {
    using Clock = std::chrono::steady_clock;
    const auto secondsSince = [](Clock::time_point begin) {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    };
    const Clock::time_point start = Clock::now();
    WaveBudget budget(settings_.work.waveSize, device_->description().isCpu);
    for (;;) {
        // The error is asked for before a pass rather than after it: a render that is continued there has to
        // ask as well.
        const bool isPassOver = position().passSamples == 0;
        if (settings_.stop.targetError > 0.0 && isPassOver && position().samplesDone > 1 &&
            errorEstimate(rendering()) <= settings_.stop.targetError)
            return StopReason::targetError;
        if (isDone())
            return StopReason::samples;
        const Clock::time_point waveStart = Clock::now();
        step(budget.slots());
        budget.took(secondsSince(waveStart));
        const double seconds = secondsSince(start);
        const double fraction = walk_.fractionDone();
        if (!keepGoing(isTimed(settings_.stop) ? std::max(fraction, seconds / settings_.stop.seconds)
                                               : fraction))
            return StopReason::interrupted;
        if (isTimed(settings_.stop) && seconds >= settings_.stop.seconds)
            return StopReason::time;
    }
}

void Renderer::continueFrom(const FilmProgress& progress, const RawFilm& film) {
    waves_->finish();
    filmIsEmptied_ = false;
    walk_.startAgain();
    film_.restore(film);
    filmIsEmptied_ = true;
    walk_.continueFrom(progress);
}

void Renderer::step(uint32_t mostSlots) {
    if (!filmIsEmptied_)
        emptyFilm();
    const Wave wave = walk_.next(mostSlots);
    waves_->renderWave(*wave.transport, wave.band, wave.range);
    if (!film_.ids().empty())
        countIds(wave.range);
    walk_.goPast(wave);
}

void Renderer::countIds(const WaveRange& range) {
    waves_->finish();
    std::vector<uint32_t> surfaces(size_t{range.pixelCount} * range.sampleCount);
    waves_->slots("Surfaces").download(std::as_writable_bytes(std::span(surfaces)));
    for (size_t layer = 0; layer < film_.ids().size(); ++layer) {
        const bool isObjects = film_.ids()[layer].name == layerNameOf(kObjectIds);
        const std::vector<uint32_t>& ids = isObjects ? surfaceIds_.objects : surfaceIds_.materials;
        for (size_t slot = 0; slot < surfaces.size(); ++slot)
            if (surfaces[slot] != kDroppedSample)
                film_.countId(layer, range.firstPixel + slot / range.sampleCount,
                              isSurface({surfaces[slot]}) ? ids[surfaces[slot]] : kNoId);
    }
}

double errorEstimate(const Rendering& rendering) {
    double sum = 0.0;
    for (size_t i = 0; i < rendering.radiance().pixels.size(); ++i) {
        const glm::dvec3 mean(rendering.radiance().pixels[i]);
        const glm::dvec3 relative = glm::dvec3(rendering.variance().pixels[i]) / (mean * mean + 0.01);
        sum += relative.x + relative.y + relative.z;
    }
    return sum / (3.0 * static_cast<double>(rendering.radiance().pixels.size()));
}

} // namespace lavalight
