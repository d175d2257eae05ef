// Command buffers: kernels and fills recorded in order, submitted, waited for, and timed by name.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/kernel.h"

namespace lavalight::gpu {

// Device time spent in kernels of one name.
struct KernelTime {
    double seconds = 0.0;
    uint64_t dispatches = 0;
};
using KernelTimes = std::map<std::string, KernelTime, std::less<>>;

// How a submission's kernels are timed.
enum class Timing {
    eachKernel, // by timestamps of the device
    // By the host's clock for all, and shared out by their workgroups. lavapipe takes 0.1 ms for a timestamp,
    // which is more than a small kernel takes.
    together,
};

// Records and runs one command buffer again and again. Every recorded command sees the writes of the ones
// before it.
class Commands {
  public:
    explicit Commands(Device& device);
    ~Commands(); // waits
    Commands(Commands&&) = default;
    Commands& operator=(Commands&& other) noexcept; // swaps: a command buffer must go before its pool

    // Starts recording anew, once what was submitted before is done.
    void begin(Timing timing = Timing::eachKernel);
    // Records `groups` workgroups along x; push constants must be as long as the kernel declares.
    void dispatch(const BoundKernel& kernel, uint32_t groups, std::span<const std::byte> pushConstants = {});
    // Records a dispatch whose workgroup counts are read from `sizes` (three uint32) at `offset` bytes.
    void dispatchIndirect(const BoundKernel& kernel, const Buffer& sizes, uint64_t offset,
                          std::span<const std::byte> pushConstants = {});
    // Sets every 32-bit word of `buffer`.
    void fill(const Buffer& buffer, uint32_t value);
    void copy(const Buffer& from, const Buffer& to, uint64_t bytes);
    // Has the device build an acceleration structure of one geometry.
    void build(const vk::AccelerationStructureBuildGeometryInfoKHR& geometry, uint32_t primitives);
    // Ends recording and has it run, behind what was submitted to the device before. Buffers and kernels must
    // live until wait(). Throws Error where the device fails or is lost.
    void submit();
    // Returns when what was submitted is done. Throws Error as above.
    // Where it takes longer than the device's kernelTimeout, DeviceConfig::onKernelTimeout is called.
    void wait();
    void submitAndWait() {
        submit();
        wait();
    }

    // Sums over all submissions so far. A queue without timestamps has no times of submissions that ask for
    // them.
    [[nodiscard]] const KernelTimes& times() const { return times_; }

  private:
    void prepareDispatch(const BoundKernel& kernel, std::span<const std::byte> pushConstants);
    void finishCommand();
    void stamp(std::string_view name, uint32_t groups = 0);
    void mark(const std::string& kernel);
    void waitUntilIdle() const;
    [[nodiscard]] bool waitForFence() const;
    void reportTimeout() const;
    [[nodiscard]] std::string unfinishedKernel() const;
    void collectTimes();
    void shareOutTime();

    Device* device_;
    vk::raii::CommandPool pool_ = nullptr;
    std::vector<vk::raii::CommandBuffer> buffers_; // exactly one
    vk::raii::Fence fence_ = nullptr;
    std::vector<vk::raii::Event> marks_; // set when a kernel of the submission is done, in order
    std::vector<std::string> marked_;    // names of the kernels of these marks
    bool isRunning_ = false;
    vk::raii::QueryPool queries_ = nullptr;
    Timing timing_ = Timing::eachKernel;
    // What ends at timestamp i; without a name: not a kernel.
    struct Stamp {
        std::string name;
        uint32_t groups = 0;
    };
    std::vector<Stamp> stamps_;
    std::chrono::steady_clock::time_point submitted_;
    KernelTimes times_;
};

// Copies the first `bytes` bytes, once.
void copyAndWait(Device& device, const Buffer& from, const Buffer& to, uint64_t bytes);

} // namespace lavalight::gpu
