#include "view/live_denoiser.h"

#include <memory>
#include <utility>

#include "base/error.h"
#include "session/denoised.h"

namespace lavalight {

LiveDenoiser::LiveDenoiser(Make make, std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this, make = std::move(make)] { run(make); }) {}

LiveDenoiser::~LiveDenoiser() {
    {
        const std::lock_guard lock(mutex_);
        isEnding_ = true;
        isStale_ = true;
    }
    orders_.notify_one();
    thread_.join();
}

void LiveDenoiser::order(size_t side, DenoiseOrder order) {
    {
        const std::lock_guard lock(mutex_);
        sides_[side].waiting = std::move(order);
    }
    orders_.notify_one();
}

void LiveDenoiser::restart(size_t side) {
    const std::lock_guard lock(mutex_);
    sides_[side] = {};
    if (busyWith_ == side)
        isStale_ = true;
}

bool LiveDenoiser::isIdle() const {
    const std::lock_guard lock(mutex_);
    return !busyWith_ && !sides_[0].waiting && !sides_[1].waiting;
}

std::optional<DenoisedPicture> LiveDenoiser::take(size_t side) {
    const std::lock_guard lock(mutex_);
    return std::exchange(sides_[side].done, std::nullopt);
}

std::string LiveDenoiser::takeError() {
    const std::lock_guard lock(mutex_);
    return std::exchange(error_, {});
}

std::string LiveDenoiser::whyNot() const {
    const std::lock_guard lock(mutex_);
    return whyNot_;
}

// The sides take turns.
std::optional<size_t> LiveDenoiser::nextSide() const {
    for (const size_t side : {1 - last_, last_})
        if (sides_[side].waiting)
            return side;
    return std::nullopt;
}

void LiveDenoiser::run(const Make& make) {
    Denoise denoise;
    try {
        denoise = make();
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        whyNot_ = error.what();
    }
    if (!denoise) {
        wake_();
        return;
    }
    for (;;) {
        std::optional<size_t> side;
        {
            std::unique_lock lock(mutex_);
            orders_.wait(lock, [&] { return isEnding_ || nextSide(); });
            if (isEnding_)
                return;
            side = nextSide();
        }
        this->denoise(denoise, *side);
    }
}

void LiveDenoiser::denoise(const Denoise& denoise, size_t side) {
    DenoiseOrder order;
    {
        const std::lock_guard lock(mutex_);
        if (!sides_[side].waiting)
            return; // the image was restarted in between
        order = *std::exchange(sides_[side].waiting, std::nullopt);
        busyWith_ = last_ = side;
        isStale_ = false;
    }
    const auto isWanted = [this] {
        const std::lock_guard lock(mutex_);
        return !isStale_;
    };
    std::optional<DenoisedPicture> picture;
    std::string error;
    try {
        picture = denoise(std::move(order), isWanted);
    } catch (const std::exception& failure) {
        error = failure.what();
    }
    {
        const std::lock_guard lock(mutex_);
        busyWith_.reset();
        if (!isStale_) {
            if (picture)
                sides_[side].done = std::move(picture);
            error_ = error;
        }
    }
    wake_();
}

LiveDenoiser::Denoise makeLibraryDenoise() {
    const auto denoiser = std::make_shared<const Denoiser>();
    return [denoiser](DenoiseOrder order, const KeepGoing& keepGoing) -> std::optional<DenoisedPicture> {
        Rendering& rendering = order.rendering;
        if (!denoise(rendering, *denoiser, order.quality, 0, order.isSharp, keepGoing))
            return std::nullopt;
        const auto copyOf = [](const Image* image) {
            return image == nullptr ? std::nullopt : std::optional(*image);
        };
        return DenoisedPicture{*rendering.findMean(kDenoisedLayer),
                               copyOf(rendering.findMean(kDenoisedCoverage)),
                               copyOf(rendering.findMean(kDenoisedShadow)), order.samples};
    };
}

} // namespace lavalight
