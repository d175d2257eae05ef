#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <mutex>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "gpu/device_selection.h"

namespace lavalight::gpu {

// Written by the validation layer from whichever thread makes the call.
struct Device::MessageLog {
    std::mutex mutex;
    std::vector<std::string> lines;

    static VKAPI_ATTR VkBool32 VKAPI_CALL append(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                 VkDebugUtilsMessageTypeFlagsEXT,
                                                 const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                 void* user) {
        auto* log = static_cast<MessageLog*>(user);
        const std::lock_guard lock(log->mutex);
        log->lines.emplace_back(data->pMessage);
        return VK_FALSE;
    }
};

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

vk::raii::Context makeContext() {
    try {
        return vk::raii::Context();
    } catch (const std::exception& error) {
        throw Error(
            fmt::format("cannot load Vulkan: {}; Debian's packages are libvulkan1 and mesa-vulkan-drivers",
                        error.what()));
    }
}

void requireValidationLayer(const vk::raii::Context& context) {
    for (const vk::LayerProperties& layer : context.enumerateInstanceLayerProperties())
        if (std::string_view(layer.layerName.data()) == kValidationLayer)
            return;
    throw Error(fmt::format("cannot validate: the layer {} is not installed; Debian's package is "
                            "vulkan-validationlayers",
                            kValidationLayer));
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validate) {
    const vk::ApplicationInfo application("lavalight", 1, nullptr, 0, VK_API_VERSION_1_2);
    const std::array enabled = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features(enabled);
    const std::array layers = {kValidationLayer};
    const std::array extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    vk::InstanceCreateInfo info({}, &application);
    if (validate) {
        requireValidationLayer(context);
        info.setPEnabledLayerNames(layers);
        info.setPEnabledExtensionNames(extensions);
        info.setPNext(&features);
    }
    const auto create = [&] { return vk::raii::Instance(context, info); };
    return checked(
        "create",
        "the Vulkan instance (is a driver installed? Debian's mesa-vulkan-drivers has one for CPUs)", create);
}

std::vector<vk::raii::PhysicalDevice> physicalDevices(const vk::raii::Instance& instance) {
    return checked("list", "the Vulkan devices", [&] {
        std::vector<vk::raii::PhysicalDevice> list;
        for (auto& device : vk::raii::PhysicalDevices(instance))
            list.push_back(std::move(device));
        return list;
    });
}

std::vector<DeviceDescription> describeAll(const std::vector<vk::raii::PhysicalDevice>& devices) {
    std::vector<DeviceDescription> descriptions;
    for (const vk::raii::PhysicalDevice& device : devices)
        descriptions.push_back(describeDevice(device, static_cast<uint32_t>(descriptions.size())));
    return descriptions;
}

uint64_t hostMemoryBytes() {
    return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(::sysconf(_SC_PAGE_SIZE));
}

DeviceLimits readLimits(const vk::raii::PhysicalDevice& physical, uint32_t queueFamily) {
    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>();
    const vk::PhysicalDeviceLimits& from = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
    DeviceLimits limits;
    limits.maxStorageBufferBytes = from.maxStorageBufferRange;
    limits.maxTexelBufferElements = from.maxTexelBufferElements;
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
    return limits;
}

} // namespace

void throwVulkanError(std::string_view operation, std::string_view object, const char* reason) {
    throw Error(fmt::format("cannot {} {}: {}", operation, object, reason));
}

std::vector<DeviceDescription> listDevices() {
    const vk::raii::Context context = makeContext();
    const vk::raii::Instance instance = makeInstance(context, false);
    return describeAll(physicalDevices(instance));
}

Device::Device(const DeviceConfig& config)
    : context_(makeContext()), messages_(std::make_unique<MessageLog>()),
      instance_(makeInstance(context_, config.validate)) {
    if (config.validate) {
        using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
        using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
        messenger_ = vk::raii::DebugUtilsMessengerEXT(
            instance_, {{},
                        Severity::eError | Severity::eWarning,
                        Type::eGeneral | Type::eValidation | Type::ePerformance,
                        &MessageLog::append,
                        messages_.get()});
    }
    std::vector<vk::raii::PhysicalDevice> devices = physicalDevices(instance_);
    const std::vector<DeviceDescription> descriptions = describeAll(devices);
    const uint32_t chosen = chooseDevice(descriptions, config);
    description_ = descriptions[chosen];
    physical_ = std::move(devices[chosen]);
    queueFamily_ = *findComputeFamily(physical_);
    limits_ = readLimits(physical_, queueFamily_);
    memory_ = physical_.getMemoryProperties();

    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queueInfo({}, queueFamily_, 1, &priority);
    device_ = checked("open", description_.name,
                      [&] { return vk::raii::Device(physical_, vk::DeviceCreateInfo({}, queueInfo)); });
    queue_ = vk::raii::Queue(device_, queueFamily_, 0);
}

Device::~Device() = default;

std::vector<std::string> Device::validationMessages() const {
    const std::lock_guard lock(messages_->mutex);
    return messages_->lines;
}

void Device::requireNoValidationMessages() const {
    const std::vector<std::string> messages = validationMessages();
    if (!messages.empty())
        throw Error(fmt::format("the validation layer has {} messages, the first: {}", messages.size(),
                                messages.front()));
}

MemoryReservation Device::reserve(uint64_t bytes, std::string_view object) {
    if (allocatedBytes_ + bytes > limits_.memoryBytes)
        throw Error(fmt::format("{} needs {:.1f} MiB, but {} has {:.1f} MiB with {:.1f} MiB in use; "
                                "render a smaller image or scene",
                                object, static_cast<double>(bytes) / 1048576.0, description_.name,
                                static_cast<double>(limits_.memoryBytes) / 1048576.0,
                                static_cast<double>(allocatedBytes_) / 1048576.0));
    MemoryReservation reservation(allocatedBytes_, bytes);
    peakAllocatedBytes_ = std::max(peakAllocatedBytes_, allocatedBytes_);
    return reservation;
}

uint32_t Device::findMemoryType(uint32_t typeBits, vk::MemoryPropertyFlags flags) const {
    for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
        if ((typeBits >> i & 1u) != 0 && (memory_.memoryTypes[i].propertyFlags & flags) == flags)
            return i;
    return ~0u;
}

} // namespace lavalight::gpu
