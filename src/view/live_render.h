// A render that goes on in a thread of its own while its user changes what it shows.
#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "gpu/device.h"
#include "view/live_picture.h"
#include "view/live_request.h"

namespace lavalight {

// What there is to tell since the last time.
struct LiveNews {
    std::array<std::optional<LiveView>, 2> views; // views of the request's settings, and of its `other` ones
    std::optional<PixelInspection> inspection;
    std::vector<std::string> messages; // news of files that were saved
    // What could not be done: the image from before goes on, unless it was the one that failed. Then there is
    // none until the next show().
    std::vector<std::string> errors;
    std::string whyNotDenoised; // why nothing can be denoised; empty: it can, or that is not known yet
    bool isReady = false;    // the newest request is what is rendered: nothing is being compiled or uploaded
    bool isFinished = false; // all samples are taken, and denoised where that is shown
};

class LiveRender {
  public:
    // Opens the device; throws Error as that does. `wake` is called from the thread whenever there is news;
    // it must return at once.
    LiveRender(const gpu::DeviceConfig& device, std::function<void()> wake);
    // Ends with the wave under way.
    ~LiveRender();
    LiveRender(const LiveRender&) = delete;
    LiveRender& operator=(const LiveRender&) = delete;

    // From then on the newest request counts.
    void show(const LiveRequest& request);
    // A path of a pixel of the window; the answer comes as news, once there is an image. Only the newest
    // counts of those that wait: the first one after a change takes as long as its kernel's compilation.
    void inspect(const glm::uvec2& pixel, uint32_t sample);
    // Writes the image as it is, or as soon as it has a sample; empty names are left out.
    void save(const std::string& exr, const std::string& png);

    // Throws Error once the thread has ended for a failure that leaves no way to go on, such as a lost
    // device.
    [[nodiscard]] LiveNews news();

    [[nodiscard]] const gpu::DeviceDescription& device() const { return device_.description(); }
    [[nodiscard]] const gpu::DeviceConfig& config() const { return config_; }

  private:
    struct Task {
        std::optional<glm::uvec2> pixel;
        uint32_t sample = 0;
        std::string exr;
        std::string png;
    };
    struct Work;

    template <typename Change>
    void order(const Change& change);
    void run();
    void loop();
    void advance(Work& work);
    [[nodiscard]] bool takeOrders(Work& work);
    void takeDenoised(Work& work);
    void orderDenoising(Work& work);
    [[nodiscard]] bool isOutdated(const Work& work);
    void change(Work& work, const LiveRequest& request);
    void publish(Work& work);
    void perform(Work& work, const Task& task);
    void report(const std::string& error);

    gpu::DeviceConfig config_;
    gpu::Device device_;
    std::function<void()> wake_;
    std::mutex mutex_; // guards everything below
    std::condition_variable orders_;
    std::optional<LiveRequest> wanted_; // request that is not being rendered yet
    std::vector<Task> tasks_;           // tasks to do on the image as soon as it has a sample
    LiveNews news_;
    bool hasDenoised_ = false; // the denoiser has something to tell
    std::string failure_;      // message of the error that ended the thread
    bool isEnding_ = false;
    std::thread thread_; // last: started when all else is there
};

} // namespace lavalight
