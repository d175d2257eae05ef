#include "view/live_side.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "gpu/vulkan_error.h"
#include "session/exposure.h"
#include "view/layer_display.h"

namespace lavalight {
namespace {

// A wave that takes longer keeps what the user does waiting. Ten frames a second are seen as movement, and a
// move is to be answered within one.
constexpr double kFrameSeconds = 0.03;

// Paths of the shortest wave: fewer do not fill the threads of a processor, whose dispatches cost 50 us each.
constexpr uint32_t kFewestSlots = 4096;

// Samples a pixel before which the logarithms of noise say too little of an image's brightness.
constexpr uint32_t kFewestToExpose = 4;

// What alpha is made of, of which a film may have none.
constexpr uint32_t kAlphaLayers = 1u << kCoveragePlane | 1u << kShadowPlane | 1u << kBehindPlane;

// Samples after which nothing is denoised any more.
constexpr uint32_t kNever = 0xffffffffu;

// The film of a moving camera has that many pixels to the window's one, in each direction, at most.
constexpr std::array<uint32_t, 6> kCoarseness{1, 2, 3, 4, 6, 8};

uint32_t coarse(uint32_t size, uint32_t by) {
    return std::max(1u, (size + by - 1) / by);
}

} // namespace

RenderSettings LiveSide::filmSettings(const LiveRequest& request) const {
    RenderSettings settings = request.settings;
    settings.stop.isProgressive = true;
    if (!request.isMoving)
        return settings;
    const auto fits = [&](uint32_t by) {
        return secondsPerPath_ * coarse(settings.image.width, by) * coarse(settings.image.height, by) <=
               kFrameSeconds;
    };
    const auto found = std::find_if(kCoarseness.begin(), kCoarseness.end(), fits);
    const uint32_t by = found == kCoarseness.end() ? kCoarseness.back() : *found;
    settings.image.width = coarse(settings.image.width, by);
    settings.image.height = coarse(settings.image.height, by);
    return settings;
}

void LiveSide::show(const LiveRequest& request) {
    const bool hasOtherShaders = request_ && request_->shaders != request.shaders;
    Restart restart = renderer_ ? restartsImage(*request_, request) : Restart::scene;
    if (restart == Restart::image &&
        !renderer_->keepsAccelerator(request.settings, sourceOf(request.shaders)))
        restart = Restart::scene;
    if (restart == Restart::image) {
        restartImage(request);
    } else if (restart == Restart::scene) {
        try {
            rebuild(request);
        } catch (const gpu::DeviceLost&) {
            throw;
        } catch (const Error&) {
            if (request_)
                rebuild(*request_);
            throw;
        }
    }
    if (hasOtherShaders)
        tracer_.reset();
    request_ = request;
}

void LiveSide::giveUp() {
    tracer_.reset();
    renderer_.reset();
    startCounting();
}

void LiveSide::restartImage(const LiveRequest& request) {
    renderer_->restart(*request.scene, request.camera, filmSettings(request), sourceOf(request.shaders));
    startCounting();
}

// The BVH is built anew, too. The scene before is given up first: two may not fit.
void LiveSide::rebuild(const LiveRequest& request) {
    const KernelSource source = sourceOf(request.shaders);
    const RenderSettings settings = filmSettings(request);
    if (renderer_ && request_->shaders == request.shaders) {
        EstimatorKernels kernels = renderer_->releaseKernels();
        renderer_.reset();
        renderer_ = std::make_unique<Renderer>(*device_, *request.scene, request.camera, settings,
                                               std::move(kernels), source);
    } else {
        renderer_.reset();
        renderer_ = std::make_unique<Renderer>(*device_, *request.scene, request.camera, settings, source);
    }
    startCounting();
}

void LiveSide::startCounting() {
    statistics_ = {};
    nextErrorAt_ = 2;
    exposedAt_ = 0;
    denoised_.reset();
    nextDenoisedAt_ = 1;
    ++imageNumber_;
}

void LiveSide::step() {
    if (!hasWork())
        return;
    const auto slots = static_cast<uint32_t>(std::min(kFrameSeconds / secondsPerPath_, 1e9));
    const uint64_t before = renderer_->waves().rays().camera;
    const auto start = std::chrono::steady_clock::now();
    renderer_->step(std::max(slots, kFewestSlots));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto paths = static_cast<double>(renderer_->waves().rays().camera - before);
    // Follows the image: some parts of it cost more than others.
    secondsPerPath_ += 0.3 * (seconds / std::max(paths, 1.0) - secondsPerPath_);
    statistics_.seconds += seconds;
    statistics_.samples = renderer_->position().samplesDone;
    if (statistics_.samples >= nextErrorAt_ && renderer_->position().passSamples == 0) {
        statistics_.error = errorEstimate(renderer_->film().resolve(1u << kColorPlane));
        nextErrorAt_ = 2 * statistics_.samples; // an estimate costs as much as reading the whole film
    }
}

LiveView LiveSide::view(const ShownLayer& shown, float exposure) {
    const WaveRenderer& waves = renderer_->waves();
    statistics_.rays = waves.rays();
    statistics_.paths = statistics_.rays.camera;
    statistics_.kernels = waves.kernelTimes();
    statistics_.raysPerBounce = waves.raysPerBounce();
    statistics_.denoisedSamples = shown.isDenoised && denoised_ ? denoised_->samples : 0;
    statistics_.exposure = exposure;
    ToneSettings tone = request_->tone;
    tone.exposure = exposure;
    const Film& film = renderer_->film();
    LivePicture picture{film.width(), film.height(), pixelsOf(shown, tone)};
    if (request_->settings.background.kind == Background::transparent)
        putOnCheckerboard(picture.pixels, picture.width,
                          {request_->settings.image.width, request_->settings.image.height});
    return {std::move(picture), statistics_};
}

// A layer that the film lacks, for the moment until it restarts with it, is the colour.
std::vector<uint32_t> LiveSide::pixelsOf(const ShownLayer& shown, const ToneSettings& tone) {
    const Film& film = renderer_->film();
    if (shown.isDenoised && denoised_)
        return toneMapper_->map(denoised_->color, denoised_->coverage ? &*denoised_->coverage : nullptr, tone,
                                denoised_->shadow ? &*denoised_->shadow : nullptr);
    if (shown.row == kColorPlane || !film.layout().find(shown.row))
        return toneMapper_->map(film, tone);
    return displayOf(film.resolve(1u << shown.row | 1u << kHitsPlane), shown.row, std::exp2(tone.exposure));
}

float LiveSide::imageExposure() {
    const uint32_t samples = renderer_->position().samplesDone;
    const bool isDue =
        renderer_->isDone() ? samples != exposedAt_ : samples >= std::max(kFewestToExpose, 2 * exposedAt_);
    if (!exposure_ || isDue) {
        exposure_ = autoExposure(renderer_->film().resolve(1u << kColorPlane | kAlphaLayers));
        exposedAt_ = samples;
    }
    return *exposure_;
}

bool LiveSide::wantsDenoising() const {
    const bool hasGuides =
        isComplete() && (renderer_->settings().layers & kDenoisingLayers) == kDenoisingLayers;
    return hasGuides && !request_->isMoving && nextDenoisedAt_ != kNever &&
           (renderer_->isDone() || renderer_->position().samplesDone >= nextDenoisedAt_);
}

DenoiseOrder LiveSide::orderDenoising() {
    const uint32_t samples = renderer_->position().samplesDone;
    nextDenoisedAt_ = renderer_->isDone() ? kNever : 2 * samples;
    const uint32_t rows = kDenoisingLayers | 1u << kColorPlane | kAlphaLayers;
    return {renderer_->film().resolve(rows), samples, renderer_->frame().lensRadius == 0.0f,
            request_->quality};
}

PixelInspection LiveSide::inspect(const glm::uvec2& pixel, uint32_t sample) {
    PixelInspection inspection;
    inspection.scene = request_->scene;
    const Film& film = renderer_->film();
    // A coarse film has a pixel for several of the window's, and the window may have been larger when it was
    // asked.
    const glm::uvec2 size(request_->settings.image.width, request_->settings.image.height);
    inspection.pixel = glm::min(pixel, size - 1u) * glm::uvec2(film.width(), film.height()) / size;
    const Rendering rendering = film.resolve();
    const size_t at = size_t{inspection.pixel.y} * film.width() + inspection.pixel.x;
    inspection.radiance = rendering.radiance().pixels[at];
    inspection.variance = rendering.variance().pixels[at];
    inspection.count = rendering.sampleCounts[at];
    inspection.sample = sample;
    if (!tracer_ || !tracer_->serves(*renderer_))
        tracer_.emplace(*device_, *renderer_, sourceOf(request_->shaders));
    inspection.path = tracer_->trace(*renderer_, inspection.pixel, sample);
    return inspection;
}

} // namespace lavalight
