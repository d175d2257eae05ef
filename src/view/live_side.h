// One image that is rendered while it is looked at.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "inspect/path_inspector.h"
#include "render/renderer.h"
#include "render/tone_mapper.h"
#include "view/live_denoiser.h"
#include "view/live_picture.h"
#include "view/live_request.h"

namespace lavalight {

class LiveSide {
  public:
    LiveSide(gpu::Device& device, ToneMapper& tone) : device_(&device), toneMapper_(&tone) {}

    // Makes the image the one that is asked for. Whatever of the one before serves is kept. Throws Error with
    // the image from before, which may have to start again, or with none where even that fails.
    void show(const LiveRequest& request);
    // Takes samples for about as long as a frame may take. Does nothing once all are taken. After an Error
    // the image is of no use: giveUp().
    void step();
    // Without an image until the next show().
    void giveUp();

    [[nodiscard]] bool hasWork() const { return renderer_ && !renderer_->isDone(); }
    // Whether each pixel has a sample.
    [[nodiscard]] bool isComplete() const { return renderer_ && renderer_->position().samplesDone > 0; }
    // Seconds spent on the image so far.
    [[nodiscard]] double seconds() const { return statistics_.seconds; }

    // The image as it is shown, with the tone of its request at that exposure.
    [[nodiscard]] LiveView view(const ShownLayer& shown, float exposure);
    // Stops that suit the image (autoExposure()); those of the image before while this one has too few
    // samples to tell.
    [[nodiscard]] float imageExposure();

    // Whether the image has so many more samples than when it was denoised last that it is worth while again.
    // Not while the camera moves.
    [[nodiscard]] bool wantsDenoising() const;
    // The image as it is, to be denoised.
    [[nodiscard]] DenoiseOrder orderDenoising();
    // Whether all its samples are in the denoised image.
    [[nodiscard]] bool isDenoised() const {
        return denoised_ && denoised_->samples == renderer_->position().samplesDone;
    }
    // Another number whenever the image starts from its first sample.
    [[nodiscard]] uint64_t imageNumber() const { return imageNumber_; }
    // Shows this where the denoised image is asked for, until the image restarts.
    void setDenoised(DenoisedPicture picture) { denoised_ = std::move(picture); }
    // Inspects the pixel nearest to that one, of the request's size. The first one compiles a kernel.
    [[nodiscard]] PixelInspection inspect(const glm::uvec2& pixel, uint32_t sample);
    // The renderer of the image, which must be there: hasImage().
    [[nodiscard]] const Renderer& renderer() const { return *renderer_; }
    [[nodiscard]] const LiveRequest& request() const { return *request_; }
    [[nodiscard]] bool hasImage() const { return renderer_ != nullptr; }

  private:
    [[nodiscard]] RenderSettings filmSettings(const LiveRequest& request) const;
    void restartImage(const LiveRequest& request);
    void rebuild(const LiveRequest& request);
    void startCounting();
    [[nodiscard]] std::vector<uint32_t> pixelsOf(const ShownLayer& shown, const ToneSettings& tone);

    gpu::Device* device_;
    ToneMapper* toneMapper_;
    std::optional<LiveRequest> request_;
    std::unique_ptr<Renderer> renderer_;
    std::optional<PathInspector> tracer_; // compiled with the request's shaders
    LiveStatistics statistics_;
    double secondsPerPath_ = 1e-6; // a first guess; then measured
    uint32_t nextErrorAt_ = 2;     // samples
    std::optional<float> exposure_;
    uint32_t exposedAt_ = 0; // samples of this image that settled exposure_; 0: another image did
    std::optional<DenoisedPicture> denoised_; // of this image
    uint32_t nextDenoisedAt_ = 1;             // samples
    uint64_t imageNumber_ = 0;
};

} // namespace lavalight
