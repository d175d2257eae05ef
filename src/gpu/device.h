// The Vulkan device: choice with reasons, limits, memory accounting.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "gpu/instance.h"
#include "gpu/memory_plan.h"
#include "gpu/vulkan_error.h"

namespace lavalight::gpu {

enum class RequiredDevice { any, cpu, gpu };

struct DeviceConfig {
    std::string wanted; // index or part of a name; empty: the first usable, GPUs first
    RequiredDevice required = RequiredDevice::any; // refuse to run on anything else
    bool validate = false;                         // Khronos validation layer with synchronisation checks
    double kernelTimeout = 300.0;                  // seconds that a submission may take; 0: any
    // Called with a message that names the kernel when a submission takes longer. What a device works on
    // cannot be taken back from it, so there is no way to clean up: a program that has to end ends here.
    // Where the function returns, or there is none, the wait goes on.
    std::function<void(const std::string& message)> onKernelTimeout{};
    // What other devices make necessary, asked of any device: for tests.
    bool stagesBuffers = false; // copies to and from buffers, whose memory is never mapped but for readback
    bool storesTexels = false;  // puts texels into storage buffers
    bool runsAhead = false;     // submits work before what was submitted earlier is done
};

// One line of `lavalight devices`.
struct DeviceDescription {
    uint32_t index = 0;
    std::string name;
    std::string driver; // name and version
    std::string type;   // "CPU", "discrete GPU", ...
    std::string apiVersion;
    std::vector<std::string> refusals; // why this device cannot render; empty: it can
    bool isCpu = false;
    bool tracesRays = false;   // kernels may ask it where rays meet triangles (VK_KHR_ray_query)
    bool sharesMemory = false; // of the device in use: the host reads and writes its buffers where they lie
};

// Every Vulkan device of this machine. Throws Error where there is no Vulkan loader or driver.
[[nodiscard]] std::vector<DeviceDescription> listDevices();

struct DeviceLimits {
    uint64_t maxStorageBufferBytes = 0;
    uint64_t maxTexelBufferElements = 0;
    uint32_t maxStorageBuffers = 0; // storage buffers of one kernel
    uint32_t maxTexelBuffers = 0;   // texel buffers of one kernel
    uint32_t maxGroups = 0;         // workgroups of one dispatch, x
    uint32_t subgroupSize = 0;
    uint64_t memoryBytes = 0;          // the largest device-local heap
    double timestampNanoseconds = 0.0; // 0: no timestamps on the queue
    uint64_t maxTracedTriangles = 0;   // of one acceleration structure; 0: the device has none
    uint64_t scratchAlignment = 1;     // bytes, of what it builds one with
};

// A share of the device's memory, given back on destruction.
class MemoryReservation {
  public:
    MemoryReservation() = default;
    // Counts `bytes` in both.
    MemoryReservation(uint64_t& ofDevice, uint64_t& ofHeap, uint64_t bytes)
        : ofDevice_(&ofDevice), ofHeap_(&ofHeap), bytes_(bytes) {
        ofDevice += bytes;
        ofHeap += bytes;
    }
    ~MemoryReservation() {
        if (ofDevice_ != nullptr) {
            *ofDevice_ -= bytes_;
            *ofHeap_ -= bytes_;
        }
    }
    MemoryReservation(MemoryReservation&& other) noexcept { swap(other); }
    MemoryReservation& operator=(MemoryReservation&& other) noexcept {
        swap(other);
        return *this;
    }

  private:
    void swap(MemoryReservation& other) noexcept {
        std::swap(ofDevice_, other.ofDevice_);
        std::swap(ofHeap_, other.ofHeap_);
        std::swap(bytes_, other.bytes_);
    }

    uint64_t* ofDevice_ = nullptr; // counts of the device, which outlives its buffers
    uint64_t* ofHeap_ = nullptr;
    uint64_t bytes_ = 0;
};

class Device {
  public:
    // Throws Error naming every refused device with its reasons when none is left.
    explicit Device(const DeviceConfig& config);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const DeviceDescription& description() const { return description_; }
    [[nodiscard]] const DeviceLimits& limits() const { return limits_; }
    // Messages of the validation layer (Instance).
    [[nodiscard]] std::vector<std::string> validationMessages() const {
        return instance_.validationMessages();
    }
    void requireNoValidationMessages() const { instance_.requireNoValidationMessages(); }
    [[nodiscard]] double kernelTimeout() const { return kernelTimeout_; } // seconds; 0: none
    void reportKernelTimeout(const std::string& message) const {
        if (onKernelTimeout_)
            onKernelTimeout_(message);
    }

    // Bytes of the buffers alive now, and the most there ever were.
    [[nodiscard]] uint64_t allocatedBytes() const { return allocatedBytes_; }
    [[nodiscard]] uint64_t peakAllocatedBytes() const { return peakAllocatedBytes_; }
    // Throws Error if `bytes` more would not fit in the device's memory; otherwise counts them while the
    // result lives.
    [[nodiscard]] MemoryReservation reserve(uint64_t bytes, uint32_t heap, std::string_view object);
    // Where such a buffer may go (gpu/memory_plan.h), best first.
    [[nodiscard]] std::vector<MemoryPlan> planMemory(const vk::MemoryRequirements& needs,
                                                     BufferUse use) const;
    [[nodiscard]] bool tracesRays() const { return description_.tracesRays; }
    // Whether texels are read from storage buffers, because texel buffers are too small or too few.
    [[nodiscard]] bool storesTexels() const { return storesTexels_; }
    // Whether the device gains from work that is submitted before the work ahead of it is done: a GPU, which
    // would idle while the host looks at its results. A CPU works for the host meanwhile.
    [[nodiscard]] bool runsAhead() const { return runsAhead_; }

    [[nodiscard]] const vk::raii::Device& handle() const { return device_; }
    [[nodiscard]] const vk::raii::Queue& queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return queueFamily_; }

  private:
    Instance instance_;
    vk::raii::PhysicalDevice physical_ = nullptr;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::PhysicalDeviceMemoryProperties memory_;
    uint32_t queueFamily_ = 0;
    double kernelTimeout_;
    std::function<void(const std::string& message)> onKernelTimeout_;
    DeviceDescription description_;
    DeviceLimits limits_;
    uint64_t allocatedBytes_ = 0;
    uint64_t peakAllocatedBytes_ = 0;
    std::array<uint64_t, VK_MAX_MEMORY_HEAPS> heapBytes_{}; // bytes of the buffers alive now, by heap
    bool stagesBuffers_;
    bool storesTexels_ = false;
    bool runsAhead_ = false;
};

} // namespace lavalight::gpu
