// Denoises pictures that are looked at, in a thread of its own: the newest of each side.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "denoise/denoiser.h"
#include "image/rendering.h"

namespace lavalight {

// A picture to be denoised.
struct DenoiseOrder {
    Rendering rendering; // with kDenoisingLayers
    uint32_t samples = 0;
    bool isSharp = true; // seen through a pinhole
    DenoiseQuality quality = DenoiseQuality::fast;
};

// A picture that was denoised.
struct DenoisedPicture {
    Image color;
    std::optional<Image> coverage; // that it is associated with
    std::optional<Image> shadow;   // the part of it that is shadow
    uint32_t samples = 0;
};

class LiveDenoiser {
  public:
    // Nothing: it was given up, as the denoiser's KeepGoing asked. Throws Error.
    using Denoise = std::function<std::optional<DenoisedPicture>(DenoiseOrder, const KeepGoing& keepGoing)>;
    // Makes what denoises; called once, in the thread. Throws Error where there is no denoiser.
    using Make = std::function<Denoise()>;

    // `wake` is called from the thread whenever there is news; it must return at once.
    LiveDenoiser(Make make, std::function<void()> wake);
    // Gives up what is under way.
    ~LiveDenoiser();
    LiveDenoiser(const LiveDenoiser&) = delete;
    LiveDenoiser& operator=(const LiveDenoiser&) = delete;

    // The picture of a side takes the place of an earlier one that waits.
    void order(size_t side, DenoiseOrder order);
    // Another image begins there: what was ordered of the one before is given up, and never comes.
    void restart(size_t side);
    // Whether nothing waits or is under way, so that an order would be taken up at once.
    [[nodiscard]] bool isIdle() const;
    // The newest picture of a side since its restart, once.
    [[nodiscard]] std::optional<DenoisedPicture> take(size_t side);
    // What failed since the last call; empty: nothing.
    [[nodiscard]] std::string takeError();
    // Why nothing can be denoised; empty: it can, or that is not known yet.
    [[nodiscard]] std::string whyNot() const;

  private:
    struct Side {
        std::optional<DenoiseOrder> waiting;
        std::optional<DenoisedPicture> done;
    };

    void run(const Make& make);
    [[nodiscard]] std::optional<size_t> nextSide() const;
    void denoise(const Denoise& denoise, size_t side);

    std::function<void()> wake_;
    mutable std::mutex mutex_; // guards everything below
    std::condition_variable orders_;
    std::array<Side, 2> sides_;
    std::optional<size_t> busyWith_; // side whose picture is under way
    bool isStale_ = false;           // nobody wants that picture any more
    size_t last_ = 1;                // side that was served last
    std::string error_;
    std::string whyNot_;
    bool isEnding_ = false;
    std::thread thread_; // last: started when all else is there
};

// What denoises by the library. Throws Error where it is not there.
[[nodiscard]] LiveDenoiser::Denoise makeLibraryDenoise();

} // namespace lavalight
