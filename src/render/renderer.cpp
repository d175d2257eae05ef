#include "render/renderer.h"

#include <algorithm>
#include <cmath>

namespace lavalight {
namespace {

FrameParameters frameFor(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                         const GpuScene& gpuScene) {
    FrameParameters frame = makeFrame(scene, camera, settings);
    frame.emitterCount = gpuScene.emitterCount();
    return frame;
}

// Samples that a pixel takes while it is in the wave: they share one update of its film words, and the vector units
// trace their camera rays together.
constexpr uint32_t kSamplesTogether = 16;

// Of `remaining` ones: more than kSamplesTogether only where the wave would not be full.
uint32_t samplesPerWave(uint32_t remaining, uint32_t waveSize, const Film& film) {
    const uint32_t bandPixels = film.bands().front().rows * film.width(); // no band has more rows than the first
    return std::min(remaining, std::max(kSamplesTogether, waveSize / bandPixels));
}

} // namespace

RenderSettings resolveSize(RenderSettings settings, const Camera& camera) {
    if (settings.width == 0) {
        const float aspect = camera.aspect.value_or(16.0f / 9.0f);
        const float width = std::round(static_cast<float>(settings.height) * aspect);
        settings.width = static_cast<uint32_t>(std::clamp(width, 1.0f, static_cast<float>(kMaxImageSide)));
    }
    return settings;
}

FrameParameters makeFrame(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    const bool isOrthographic = camera.projection == Projection::orthographic;
    const float halfHeight = isOrthographic ? camera.halfHeight : std::tan(0.5f * camera.verticalFov);
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    FrameParameters frame{};
    frame.cameraPosition = camera.position;
    frame.isOrthographic = isOrthographic ? 1 : 0;
    frame.cameraRight = camera.right * (halfHeight * aspect);
    frame.cameraUp = camera.up * halfHeight;
    frame.cameraForward = camera.forward;
    frame.imageWidth = settings.width;
    frame.imageHeight = settings.height;
    frame.seed = settings.estimator.seed;
    frame.environment = settings.environment.value_or(scene.environment);
    frame.maxBounces = settings.estimator.maxBounces;
    frame.rouletteStart = settings.estimator.rouletteStart;
    frame.waveSize = settings.waveSize;
    return frame;
}

Renderer::Renderer(gpu::Device& device, const Scene& scene, const Camera& camera, const RenderSettings& settings)
    : settings_(settings), scene_(device, scene),
      film_(device, settings.width, settings.height, settings.bandRows),
      wavefront_(device, scene_, film_, settings, frameFor(scene, camera, settings, scene_)) {}

void Renderer::render(const KeepGoing& keepGoing) {
    for (uint32_t done = 0; done < settings_.samples;) {
        const uint32_t count = samplesPerWave(settings_.samples - done, settings_.waveSize, film_);
        for (size_t band = 0; band < film_.bands().size(); ++band)
            if (!renderBand(band, settings_.firstSample + done, count, keepGoing))
                return;
        done += count;
    }
}

bool Renderer::renderBand(size_t band, uint32_t firstSample, uint32_t sampleCount, const KeepGoing& keepGoing) {
    const FilmBand& rows = film_.bands()[band];
    const uint32_t first = rows.firstRow * film_.width();
    const uint32_t pixels = rows.rows * film_.width();
    const double total = static_cast<double>(settings_.samples) * film_.width() * film_.height();
    for (uint32_t done = 0; done < pixels;) {
        const uint32_t count = std::min(settings_.waveSize / sampleCount, pixels - done);
        wavefront_.renderWave(band, {first + done, count, firstSample, sampleCount, first, 0});
        done += count;
        pathsDone_ += uint64_t{count} * sampleCount;
        if (!keepGoing(static_cast<double>(pathsDone_) / total))
            return false;
    }
    return true;
}

} // namespace lavalight
