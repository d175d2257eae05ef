#include "gpu/device.h"

#include <algorithm>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "gpu/device_selection.h"

namespace lavalight::gpu {

namespace {

std::vector<DeviceDescription> describeAll(const std::vector<vk::raii::PhysicalDevice>& devices) {
    std::vector<DeviceDescription> descriptions;
    descriptions.reserve(devices.size());
    for (const vk::raii::PhysicalDevice& device : devices)
        descriptions.push_back(describeDevice(device, static_cast<uint32_t>(descriptions.size())));
    return descriptions;
}

uint64_t hostMemoryBytes() {
    return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(::sysconf(_SC_PAGE_SIZE));
}

DeviceLimits readLimits(const vk::raii::PhysicalDevice& physical, uint32_t queueFamily, bool tracesRays) {
    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>();
    const vk::PhysicalDeviceLimits& from = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
    DeviceLimits limits;
    limits.maxStorageBufferBytes = from.maxStorageBufferRange;
    limits.maxTexelBufferElements = from.maxTexelBufferElements;
    limits.maxStorageBuffers = from.maxPerStageDescriptorStorageBuffers;
    limits.maxTexelBuffers = from.maxPerStageDescriptorSampledImages;
    limits.maxGroups = from.maxComputeWorkGroupCount[0];
    limits.subgroupSize = chain.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize;
    if (physical.getQueueFamilyProperties()[queueFamily].timestampValidBits != 0)
        limits.timestampNanoseconds = static_cast<double>(from.timestampPeriod);
    for (const vk::MemoryHeap& heap : physical.getMemoryProperties().memoryHeaps)
        if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            limits.memoryBytes = std::max<uint64_t>(limits.memoryBytes, heap.size);
    if (physical.getProperties().deviceType == vk::PhysicalDeviceType::eCpu)
        limits.memoryBytes =
            std::max(limits.memoryBytes, hostMemoryBytes()); // Mesa 22.3 reports a heap of 2 GiB
    if (tracesRays) {
        const auto structures = physical
                                    .getProperties2<vk::PhysicalDeviceProperties2,
                                                    vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                                    .get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
        limits.maxTracedTriangles = structures.maxPrimitiveCount;
        limits.scratchAlignment = structures.minAccelerationStructureScratchOffsetAlignment;
    }
    return limits;
}

vk::raii::Device openDevice(const vk::raii::PhysicalDevice& physical, uint32_t queueFamily, bool tracesRays) {
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, queueFamily, 1, &priority);
    vk::PhysicalDeviceBufferDeviceAddressFeatures addresses(VK_TRUE);
    vk::PhysicalDeviceAccelerationStructureFeaturesKHR structures(VK_TRUE);
    vk::PhysicalDeviceRayQueryFeaturesKHR queries(VK_TRUE);
    addresses.pNext = &structures;
    structures.pNext = &queries;
    vk::DeviceCreateInfo info({}, queue);
    if (tracesRays) {
        info.setPEnabledExtensionNames(kRayExtensions);
        info.setPNext(&addresses);
    }
    const auto lock = lockLoader();
    return {physical, info};
}

} // namespace

std::vector<DeviceDescription> listDevices() {
    return describeAll(Instance(false).physicalDevices());
}

Device::Device(const DeviceConfig& config)
    : instance_(config.validate), kernelTimeout_(config.kernelTimeout),
      onKernelTimeout_(config.onKernelTimeout), stagesBuffers_(config.stagesBuffers) {
    std::vector<vk::raii::PhysicalDevice> devices = instance_.physicalDevices();
    const std::vector<DeviceDescription> descriptions = describeAll(devices);
    const uint32_t chosen = chooseDevice(descriptions, config);
    description_ = descriptions[chosen];
    physical_ = std::move(devices[chosen]);
    queueFamily_ = *findComputeFamily(physical_);
    limits_ = readLimits(physical_, queueFamily_, description_.tracesRays);
    memory_ = physical_.getMemoryProperties();
    const std::vector<MemoryPlan> plans =
        gpu::planMemory(memory_, heapBytes_, {BufferUse::storage, 0, ~0u, stagesBuffers_});
    description_.sharesMemory = description_.isCpu && !plans.empty() && plans.front().isReadMapped;
    runsAhead_ = config.runsAhead || !description_.isCpu;
    storesTexels_ = config.storesTexels || !hasTexelBuffers(physical_.getProperties().limits);

    device_ = checked("open", description_.name,
                      [&] { return openDevice(physical_, queueFamily_, description_.tracesRays); });
    queue_ = vk::raii::Queue(device_, queueFamily_, 0);
}

Device::~Device() {
    const auto lock = lockLoader();
    queue_ = nullptr;
    device_ = nullptr;
}

MemoryReservation Device::reserve(uint64_t bytes, uint32_t heap, std::string_view object) {
    if (allocatedBytes_ + bytes > limits_.memoryBytes)
        throw Error(fmt::format("{} needs {:.1f} MiB, but {} has {:.1f} MiB with {:.1f} MiB in use; "
                                "render a smaller image or scene",
                                object, static_cast<double>(bytes) / 1048576.0, description_.name,
                                static_cast<double>(limits_.memoryBytes) / 1048576.0,
                                static_cast<double>(allocatedBytes_) / 1048576.0));
    MemoryReservation reservation(allocatedBytes_, heapBytes_[heap], bytes);
    peakAllocatedBytes_ = std::max(peakAllocatedBytes_, allocatedBytes_);
    return reservation;
}

std::vector<MemoryPlan> Device::planMemory(const vk::MemoryRequirements& needs, BufferUse use) const {
    return gpu::planMemory(memory_, heapBytes_, {use, needs.size, needs.memoryTypeBits, stagesBuffers_});
}

} // namespace lavalight::gpu
