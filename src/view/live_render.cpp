#include "view/live_render.h"

#include <chrono>
#include <exception>
#include <utility>

#include "base/error.h"
#include "view/live_side.h"
#include "view/save_image.h"

namespace lavalight {
namespace {

using Clock = std::chrono::steady_clock;

// Between pictures of an image that grows: tone mapping all pixels is a few per cent of that.
constexpr std::chrono::milliseconds kPictureEvery(200);

} // namespace

// What the thread has in hand.
struct LiveRender::Work {
    Work(gpu::Device& device, const std::function<void()>& wake)
        : tone(device), sides{LiveSide(device, tone), LiveSide(device, tone)},
          sharesProcessors(device.description().isCpu), denoiser(makeLibraryDenoise, wake) {}

    // Shows both sides of what is asked for, or throws Error with what they showed before.
    void show(gpu::Device& device, const LiveRequest& request);
    [[nodiscard]] bool isComplete() const {
        return sides[0].isComplete() && (!hasOther || sides[1].isComplete());
    }
    // The side that has had less time, of those that have work; null: none has.
    [[nodiscard]] LiveSide* next() {
        LiveSide* chosen = nullptr;
        for (LiveSide* side : {&sides[0], hasOther ? &sides[1] : nullptr})
            if (side != nullptr && side->hasWork() &&
                (chosen == nullptr || side->seconds() < chosen->seconds()))
                chosen = side;
        return chosen;
    }

    // Whether the denoised picture of an image is shown on one of the halves.
    [[nodiscard]] bool showsDenoised(size_t side) const {
        const LiveRequest& request = sides[0].request();
        const bool isLeft = side == 0 && request.shown[0].isDenoised;
        return isLeft || (request.isSplit && side == (hasOther ? 1u : 0u) && request.shown[1].isDenoised);
    }

    // The exposure that the pictures are shown with.
    [[nodiscard]] float exposure() {
        const LiveRequest& request = sides[0].request();
        return request.exposesByImage ? sides[0].imageExposure() : request.tone.exposure;
    }
    [[nodiscard]] SavedPicture saved() { return {showsDenoised(0) && denoiser.whyNot().empty(), exposure()}; }
    [[nodiscard]] bool isDenoised() const {
        for (size_t side = 0; side < 2; ++side)
            if (showsDenoised(side) && denoiser.whyNot().empty() && !sides[side].isDenoised())
                return false;
        return true;
    }
    // Gives up what was ordered of images that a request will start again, which then has the processors.
    void dropOutdated(const LiveRequest& request) {
        if (sides[0].hasImage() && restartsImage(sides[0].request(), request) != Restart::nothing)
            for (size_t side = 0; side < 2; ++side)
                denoiser.restart(side);
    }
    // Gives up what was ordered of images that have started again.
    void dropStale() {
        for (size_t side = 0; side < 2; ++side)
            if (std::exchange(imageNumbers[side], sides[side].imageNumber()) != sides[side].imageNumber())
                denoiser.restart(side);
    }

    // Whether samples wait for the denoiser, on the processors that both work on: a picture is clean sooner,
    // and what the user does, which ends the denoising, waits for no wave.
    [[nodiscard]] bool isHeld() const {
        return sharesProcessors && denoiser.whyNot().empty() && !denoiser.isIdle();
    }

    ToneMapper tone;
    std::array<LiveSide, 2> sides; // images: the second is rendered where it has settings of its own
    bool sharesProcessors;
    bool hasOther = false;
    bool isNew = false; // no picture of it has been shown
    Clock::time_point shown{};
    std::array<uint64_t, 2> imageNumbers{};
    LiveDenoiser denoiser; // last: its thread wakes this one
};

LiveRender::LiveRender(const gpu::DeviceConfig& device, std::function<void()> wake)
    : config_(device), device_(device), wake_(std::move(wake)), thread_([this] { run(); }) {}

// Whoever gives orders waits no longer than for another one.
template <typename Change>
void LiveRender::order(const Change& change) {
    {
        const std::lock_guard lock(mutex_);
        change();
    }
    orders_.notify_one();
}

LiveRender::~LiveRender() {
    order([&] { isEnding_ = true; });
    thread_.join();
}

void LiveRender::show(const LiveRequest& request) {
    order([&] {
        wanted_ = request;
        news_.isReady = false;
    });
}

void LiveRender::inspect(const glm::uvec2& pixel, uint32_t sample) {
    order([&] {
        std::erase_if(tasks_, [](const Task& task) { return task.pixel.has_value(); });
        tasks_.push_back({pixel, sample, {}, {}});
    });
}

void LiveRender::save(const std::string& exr, const std::string& png) {
    order([&] { tasks_.push_back({std::nullopt, 0, exr, png}); });
}

LiveNews LiveRender::news() {
    const std::lock_guard lock(mutex_);
    if (!failure_.empty())
        throw Error(failure_);
    LiveNews news = std::move(news_);
    news_ = {};
    news_.isReady = news.isReady;
    news_.isFinished = news.isFinished;
    news_.whyNotDenoised = news.whyNotDenoised;
    return news;
}

void LiveRender::run() {
    try {
        loop();
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        failure_ = error.what();
    }
    wake_();
}

// Renders wave after wave, and listens in between.
void LiveRender::loop() {
    Work work(device_, [this] { order([this] { hasDenoised_ = true; }); });
    while (takeOrders(work)) {
        try {
            advance(work);
        } catch (const gpu::DeviceLost&) {
            throw;
        } catch (const Error& error) { // whatever fails in the midst of a wave leaves a film of no use
            for (LiveSide& side : work.sides)
                side.giveUp();
            work.dropStale();
            report(error.what());
        }
        device_.requireNoValidationMessages();
    }
}

// Whether another image is asked for, so that nothing slow shall be done to this one. A picture of a moving
// camera is shown all the same: there is always a newer one.
bool LiveRender::isOutdated(const Work& work) {
    if (!work.sides[0].hasImage() || work.sides[0].request().isMoving)
        return false;
    const std::lock_guard lock(mutex_);
    return wanted_.has_value() || isEnding_;
}

void LiveRender::advance(Work& work) {
    if (LiveSide* side = work.isHeld() ? nullptr : work.next())
        side->step();
    const bool isDone = work.next() == nullptr;
    const bool isDue = work.isNew || isDone || Clock::now() - work.shown >= kPictureEvery;
    if (work.isComplete() && isDue && !isOutdated(work))
        publish(work);
    if (!isOutdated(work)) // last: a picture that is on its way shall not wait for processors
        orderDenoising(work);
}

// The side that has waited longest comes first: the denoiser takes one at a time.
void LiveRender::orderDenoising(Work& work) {
    for (size_t side = 0; side < (work.hasOther ? 2u : 1u); ++side)
        if (work.sides[side].hasImage() && work.showsDenoised(side) && work.sides[side].wantsDenoising() &&
            work.denoiser.isIdle() && work.denoiser.whyNot().empty())
            work.denoiser.order(side, work.sides[side].orderDenoising());
}

void LiveRender::takeDenoised(Work& work) {
    for (size_t side = 0; side < 2; ++side)
        if (std::optional<DenoisedPicture> picture = work.denoiser.take(side)) {
            work.sides[side].setDenoised(std::move(*picture));
            work.isNew = true;
        }
    if (const std::string error = work.denoiser.takeError(); !error.empty())
        report(error);
    {
        const std::lock_guard lock(mutex_);
        news_.whyNotDenoised = work.denoiser.whyNot();
    }
    wake_();
}

// Waits for something to do; false: it is over.
bool LiveRender::takeOrders(Work& work) {
    std::optional<LiveRequest> request;
    std::vector<Task> tasks;
    bool hasDenoised = false;
    {
        std::unique_lock lock(mutex_);
        const bool isComplete = work.sides[0].isComplete();
        orders_.wait(lock, [&] {
            return isEnding_ || wanted_ || hasDenoised_ || (isComplete && !tasks_.empty()) ||
                   (work.next() != nullptr && !work.isHeld());
        });
        if (isEnding_)
            return false;
        hasDenoised = std::exchange(hasDenoised_, false);
        request = std::exchange(wanted_, std::nullopt);
        if (!request && isComplete)
            tasks = std::exchange(tasks_, {});
    }
    if (hasDenoised)
        takeDenoised(work);
    if (request)
        change(work, *request);
    for (const Task& task : tasks)
        perform(work, task);
    return true;
}

void LiveRender::Work::show(gpu::Device& device, const LiveRequest& request) {
    const KernelSource source = sourceOf(request.shaders);
    std::optional<ToneMapper> fresh;
    if (tone.isChanged(source))
        fresh.emplace(device, source);
    const std::optional<LiveRequest> before =
        sides[0].hasImage() ? std::optional(sides[0].request()) : std::nullopt;
    sides[0].show(request);
    if (request.other) {
        LiveRequest other = request;
        other.settings.estimator = *request.other;
        other.settings.estimator.seed = request.settings.estimator.seed;
        try {
            sides[1].show(other);
        } catch (const gpu::DeviceLost&) {
            throw;
        } catch (const Error&) {
            if (before)
                sides[0].show(*before);
            throw;
        }
    }
    hasOther = request.other.has_value();
    if (fresh)
        tone = std::move(*fresh);
}

// What fails for one request may do for another; only without a device nothing will.
void LiveRender::change(Work& work, const LiveRequest& request) {
    work.isNew = true;
    work.dropOutdated(request);
    try {
        work.show(device_, request);
    } catch (const gpu::DeviceLost&) {
        throw;
    } catch (const Error& error) {
        report(error.what());
    }
    work.dropStale();
}

void LiveRender::perform(Work& work, const Task& task) {
    try {
        if (task.pixel) {
            PixelInspection inspection = work.sides[0].inspect(*task.pixel, task.sample);
            const std::lock_guard lock(mutex_);
            news_.inspection = std::move(inspection);
        } else {
            std::string message =
                saveImage(work.sides[0], work.saved(), work.tone, device_, {task.exr, task.png, {}, {}});
            const std::lock_guard lock(mutex_);
            news_.messages.push_back(std::move(message));
        }
    } catch (const gpu::DeviceLost&) {
        throw;
    } catch (const Error& error) {
        report(error.what());
    }
    wake_();
}

void LiveRender::publish(Work& work) {
    std::array<std::optional<LiveView>, 2> views;
    const LiveRequest& request = work.sides[0].request();
    const float exposure = work.exposure();
    views[0] = work.sides[0].view(request.shown[0], exposure);
    if (request.isSplit)
        views[1] = work.sides[work.hasOther ? 1 : 0].view(request.shown[1], exposure);
    work.isNew = false;
    work.shown = Clock::now();
    {
        const std::lock_guard lock(mutex_);
        news_.views = std::move(views);
        news_.isReady = !wanted_;
        news_.isFinished = work.next() == nullptr && work.isDenoised();
    }
    wake_();
}

void LiveRender::report(const std::string& error) {
    {
        const std::lock_guard lock(mutex_);
        news_.errors.push_back(error);
    }
    wake_();
}

} // namespace lavalight
