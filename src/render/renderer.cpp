#include "render/renderer.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

#include "device_scene/scene_features.h"
#include "render/wave_budget.h"
#include "scene/clipping.h"
#include "scene/view_extent.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

static_assert(static_cast<uint32_t>(Projection::perspective) == kProjectionPerspective &&
              static_cast<uint32_t>(Projection::orthographic) == kProjectionOrthographic &&
              static_cast<uint32_t>(Projection::panorama) == kProjectionPanorama);

// Slots of a wave where the settings leave it open. On lavapipe with two threads, larger waves make the fused
// kernel no faster, and the wavefront by a tenth at 2^20; --time and Ctrl-C wait for the end of a wave.
constexpr uint32_t kWaveSize = 1u << 18;

// Samples that a pixel takes while it is in the wave: they share one update of its film words, and the vector
// units trace their camera rays together.
constexpr uint32_t kSamplesTogether = 16;

// Mesa 22.3's lavapipe ends all loops of an invocation without a word after 65,535 turns in sum, and
// accumulate makes four turns a sample and plane: beyond 16,000 samples it lost some (measured: 1x1 pixel,
// 65536 samples in one wave).
constexpr uint32_t kMostSamplesTogether = 4096; // divided by the film's planes

// Samples a pixel takes in a wave where `remaining` are left: more than kSamplesTogether only where the wave
// would not be full.
uint32_t samplesPerWave(uint32_t remaining, uint32_t waveSize, const Film& film) {
    const uint32_t bandPixels =
        film.bands().front().rows * film.width(); // no band has more rows than the first
    const auto most = kMostSamplesTogether / static_cast<uint32_t>(film.layout().planes().size());
    return std::min(remaining, std::clamp(waveSize / bandPixels, kSamplesTogether, most));
}

// Constant radiance, or what the map's texels are multiplied by.
glm::vec3 environmentFactor(const Scene& scene, const RenderSettings& settings) {
    const glm::vec3 unscaled =
        scene.environmentMap ? glm::vec3(1.0f) : settings.lighting.constant.value_or(scene.environment);
    return settings.lighting.intensity * unscaled;
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

RenderSettings resolveSchedule(RenderSettings settings, bool isCpu) {
    if (settings.work.schedule == Schedule::automatic)
        settings.work.schedule = isCpu ? Schedule::fused : Schedule::wavefront;
    if (settings.work.waveSize == 0)
        settings.work.waveSize = kWaveSize;
    return settings;
}

FrameParameters makeFrame(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    const ViewExtent view = viewExtent(camera, static_cast<float>(settings.image.width),
                                       static_cast<float>(settings.image.height));
    const ClipRange clip = neededClipping(scene, camera, view);
    FrameParameters frame{};
    frame.cameraPosition = camera.position;
    frame.projection = static_cast<uint32_t>(camera.projection);
    frame.cameraRight = camera.right * view.halfWidth;
    frame.cameraUp = camera.up * view.halfHeight;
    frame.cameraForward = camera.forward;
    frame.clipNear = clip.nearest;
    frame.clipDepth = clip.depth;
    frame.lensRadius = camera.lensRadius;
    frame.focusDistance = camera.focusDistance;
    frame.imageWidth = settings.image.width;
    frame.imageHeight = settings.image.height;
    frame.seed = settings.estimator.seed;
    frame.environmentLight = kNoLight;
    frame.environmentRotation = settings.lighting.rotation / 360.0f;
    frame.sceneCenter = scene.bounds.center();
    frame.sceneRadius = scene.bounds.radius();
    frame.maxBounces = settings.estimator.maxBounces;
    frame.rouletteStart = settings.estimator.rouletteStart;
    frame.rouletteProbability = settings.estimator.rouletteProbability;
    frame.clampIndirect = settings.estimator.clampIndirect;
    frame.waveSize = settings.work.waveSize;
    return frame;
}

void setLights(FrameParameters& frame, const Lights& lights) {
    frame.environment = lights.environmentRadiance;
    frame.environmentLight = lights.environment.value_or(kNoLight);
    frame.environmentWidth = lights.environmentMap ? lights.environmentMap->width : 0;
    frame.environmentHeight = lights.environmentMap ? lights.environmentMap->height : 0;
    frame.firstLightColumn = lights.firstColumn;
    frame.lightColumns = static_cast<uint32_t>(lights.table.size());
}

namespace {

// The parameters that setLights() sets.
void copyLights(const FrameParameters& from, FrameParameters& to) {
    to.environment = from.environment;
    to.environmentLight = from.environmentLight;
    to.environmentWidth = from.environmentWidth;
    to.environmentHeight = from.environmentHeight;
    to.firstLightColumn = from.firstLightColumn;
    to.lightColumns = from.lightColumns;
}

} // namespace

bool keepsLights(const RenderSettings& a, const RenderSettings& b) {
    return a.estimator.lightSelection == b.estimator.lightSelection &&
           (a.estimator.mis == Mis::off) == (b.estimator.mis == Mis::off) &&
           a.lighting.constant == b.lighting.constant && a.lighting.mapFile == b.lighting.mapFile &&
           a.lighting.intensity == b.lighting.intensity;
}

// The slow work before a render can start: the BVH is built on the host while the driver compiles the
// kernels.
struct Renderer::Setup {
    FrameParameters frame;
    EstimatorKernels kernels;
    SceneData scene;
    LightSelection lightSelection;

    using MakeKernels = std::function<EstimatorKernels(SceneFeatures features)>;

    static Setup make(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                      const MakeKernels& makeKernels) {
        const EstimatorSettings& estimator = settings.estimator;
        const Lights lights = collectLights(scene, environmentFactor(scene, settings),
                                            estimator.lightSelection, estimator.mis != Mis::off);
        std::future<SceneData> packed =
            std::async(std::launch::async, [&] { return packScene(scene, lights); });
        FrameParameters frame = makeFrame(scene, camera, settings);
        setLights(frame, lights);
        EstimatorKernels kernels = makeKernels(sceneFeatures(scene, lights) | cameraFeatures(camera));
        return {frame, std::move(kernels), packed.get(), lights.selection};
    }
};

// The parts that restart() makes, built beside those that they replace.
struct Renderer::Fresh {
    RenderSettings settings;
    FrameParameters frame;
    std::optional<EstimatorKernels> kernels{}; // none: the present ones serve, but for `changed`
    KernelMap changed{};
    std::optional<AlbedoTable> albedoTable{}; // none: the present one serves
    std::optional<Film> film{};               // none: the present one serves, emptied
};

Renderer::Renderer(gpu::Device& device, const Scene& scene, const Camera& camera,
                   const RenderSettings& wanted, const KernelSource& source)
    : Renderer(
          device, resolveSchedule(wanted, device.description().isCpu),
          [&](const RenderSettings& settings) {
              return Setup::make(scene, camera, settings, [&](SceneFeatures features) {
                  return EstimatorKernels(device, settings.work.schedule, settings.estimator, features,
                                          source);
              });
          },
          source) {}

Renderer::Renderer(gpu::Device& device, const Scene& scene, const Camera& camera,
                   const RenderSettings& wanted, EstimatorKernels earlier, const KernelSource& source)
    : Renderer(
          device, resolveSchedule(wanted, device.description().isCpu),
          [&](const RenderSettings& settings) {
              return Setup::make(scene, camera, settings, [&](SceneFeatures features) {
                  if (earlier.serve(settings.work.schedule, settings.estimator, features))
                      return std::move(earlier);
                  return EstimatorKernels(device, settings.work.schedule, settings.estimator, features,
                                          source);
              });
          },
          source) {}

Renderer::Renderer(gpu::Device& device, const RenderSettings& settings,
                   const std::function<Setup(const RenderSettings&)>& setUp, const KernelSource& source)
    : Renderer(device, settings, setUp(settings), source) {}

Renderer::Renderer(gpu::Device& device, const RenderSettings& settings, Setup setup,
                   const KernelSource& source)
    : device_(&device), settings_(settings), frame_(setup.frame), sceneFeatures_(setup.scene.features),
      kernels_(std::move(setup.kernels)), scene_(device, setup.scene, source),
      film_(device, settings.image.width, settings.image.height, settings.work.bandRows),
      waves_(makeWaves(Fresh{settings_, frame_})) {
    settings_.estimator.lightSelection = setup.lightSelection;
}

bool Renderer::wantsAlbedoTable(const KernelSource& source) const {
    const std::string& content = scene_.albedoTable().kernelContent;
    return !content.empty() && source("albedo").content != content;
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
    Fresh fresh{settings_, frame_};
    compileChanged(fresh, source);
    startAnew(std::move(fresh));
}

void Renderer::restart(const Scene& scene, const Camera& camera, const RenderSettings& wanted,
                       const KernelSource& source) {
    Fresh fresh{resolveSchedule(wanted, device_->description().isCpu), {}};
    fresh.settings.estimator.lightSelection = settings_.estimator.lightSelection;
    fresh.frame = makeFrame(scene, camera, fresh.settings);
    copyLights(frame_, fresh.frame);
    const SceneFeatures features = sceneFeatures_ | cameraFeatures(camera);
    const EstimatorSettings& estimator = fresh.settings.estimator;
    if (!kernels_.serve(fresh.settings.work.schedule, estimator, features))
        fresh.kernels.emplace(*device_, fresh.settings.work.schedule, estimator, features, source);
    compileChanged(fresh, source);
    if (fresh.settings.image.width != film_.width() || fresh.settings.image.height != film_.height())
        fresh.film.emplace(*device_, fresh.settings.image.width, fresh.settings.image.height,
                           fresh.settings.work.bandRows, film_.layout());
    startAnew(std::move(fresh));
}

// Waves bound to the fresh parts, and to the present ones where nothing is fresh.
std::unique_ptr<WaveRenderer> Renderer::makeWaves(const Fresh& fresh) const {
    const Schedule schedule = fresh.settings.work.schedule;
    const std::vector<std::string_view> names = estimatorKernelNames(schedule);
    const auto kernel = [&](std::string_view name) -> const gpu::Kernel& {
        const auto found = fresh.changed.find(name);
        return found != fresh.changed.end() ? found->second
                                            : (fresh.kernels ? *fresh.kernels : kernels_)[name];
    };
    const AlbedoTable& albedo = fresh.albedoTable ? *fresh.albedoTable : scene_.albedoTable();
    return makeWaveRenderer(
        *device_, schedule,
        {scene_, albedo.buffer, fresh.film ? *fresh.film : film_, fresh.frame, names, kernel});
}

// Everything that may fail comes first; what is bound to kernels and film goes before them.
void Renderer::startAnew(Fresh fresh) {
    std::unique_ptr<WaveRenderer> waves = makeWaves(fresh);
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
    filmIsEmptied_ = true;
    settings_ = fresh.settings;
    frame_ = fresh.frame;
    position_ = {};
}

// A failure here leaves the film emptied, or not.
void Renderer::emptyFilm() {
    filmIsEmptied_ = false;
    position_ = {};
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
        const bool isPassOver = position_.passSamples == 0;
        if (settings_.stop.targetError > 0.0 && isPassOver && position_.samplesDone > 1 &&
            errorEstimate(rendering()) <= settings_.stop.targetError)
            return StopReason::targetError;
        if (isDone())
            return StopReason::samples;
        const Clock::time_point waveStart = Clock::now();
        step(budget.slots());
        budget.took(secondsSince(waveStart));
        const double seconds = secondsSince(start);
        if (!keepGoing(isTimed() ? std::max(fractionDone(), seconds / settings_.stop.seconds)
                                 : fractionDone()))
            return StopReason::interrupted;
        if (isTimed() && seconds >= settings_.stop.seconds)
            return StopReason::time;
    }
}

FilmProgress Renderer::progress() const {
    const uint32_t firstRow = film_.bands()[position_.band].firstRow;
    return {position_.samplesDone, position_.passSamples, firstRow * film_.width() + position_.pixel};
}

void Renderer::continueFrom(const FilmProgress& progress, const RawFilm& film) {
    assert(progress.passSamples <= settings_.work.waveSize);
    waves_->finish();
    filmIsEmptied_ = false;
    position_ = {};
    film_.restore(film);
    filmIsEmptied_ = true;
    // Pixels of each band but the last.
    const uint32_t bandPixels = film_.bands().front().rows * film_.width();
    position_ = {progress.samples, progress.passSamples, progress.passPixels / bandPixels,
                 progress.passPixels % bandPixels};
}

void Renderer::step(uint32_t mostSlots) {
    assert(!isDone());
    if (!filmIsEmptied_)
        emptyFilm();
    RenderPosition& at = position_;
    if (at.passSamples == 0)
        at.passSamples = nextPass();
    const FilmBand& rows = film_.bands()[at.band];
    const uint32_t first = rows.firstRow * film_.width();
    const uint32_t pixels = rows.rows * film_.width();
    const uint32_t slots = std::min(mostSlots, settings_.work.waveSize);
    const uint32_t count = std::clamp(slots / at.passSamples, 1u, pixels - at.pixel);
    waves_->renderWave(at.band, {first + at.pixel, count, settings_.image.firstSample + at.samplesDone,
                                 at.passSamples, first, 0, 0, 0, 0});
    at.pixel += count;
    if (at.pixel == pixels) {
        at.pixel = 0;
        ++at.band;
    }
    if (at.band == film_.bands().size()) {
        at.band = 0;
        at.samplesDone += at.passSamples;
        at.passSamples = 0;
    }
}

// A render that may stop at any moment starts with passes of few samples, so that every pixel has some.
uint32_t Renderer::nextPass() const {
    const uint32_t done = position_.samplesDone;
    const uint32_t count = samplesPerWave(settings_.stop.samples - done, settings_.work.waveSize, film_);
    const bool mayStop = settings_.stop.isProgressive || isTimed() || settings_.stop.targetError > 0.0;
    return mayStop ? std::min(count, std::max(1u, done)) : count;
}

double Renderer::fractionDone() const {
    const double pixels = static_cast<double>(film_.width()) * film_.height();
    const uint32_t row = isDone() ? 0 : film_.bands()[position_.band].firstRow;
    const double before = static_cast<double>(row) * film_.width() + position_.pixel;
    return (position_.samplesDone + position_.passSamples * before / pixels) / settings_.stop.samples;
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
