#include "gpu/device_selection.h"

#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"

namespace lavalight::gpu {
namespace {

constexpr uint32_t kWorkgroupSize = 64;
constexpr uint64_t kMinTexelElements = 1u << 20;

std::string versionText(uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string typeText(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eCpu:
        return "CPU";
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return "discrete GPU";
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return "integrated GPU";
    case vk::PhysicalDeviceType::eVirtualGpu:
        return "virtual GPU";
    default:
        return "other";
    }
}

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool hasRayQueries(const vk::raii::PhysicalDevice& physical) {
    const std::vector<vk::ExtensionProperties> there = physical.enumerateDeviceExtensionProperties();
    const auto isThere = [&](std::string_view name) {
        return std::ranges::any_of(
            there, [&](const vk::ExtensionProperties& one) { return name == one.extensionName.data(); });
    };
    if (!std::ranges::all_of(kRayExtensions, isThere))
        return false;
    const auto features =
        physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceBufferDeviceAddressFeatures,
                              vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                              vk::PhysicalDeviceRayQueryFeaturesKHR>();
    return features.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>().bufferDeviceAddress == VK_TRUE &&
           features.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure ==
               VK_TRUE &&
           features.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery == VK_TRUE;
}

// Why `device` is not what `config` asks for; empty: it is.
std::vector<std::string> unwanted(const DeviceDescription& device, const DeviceConfig& config) {
    std::vector<std::string> reasons = device.refusals;
    if (config.required == RequiredDevice::cpu && !device.isCpu)
        reasons.emplace_back("--require-device cpu");
    if (config.required == RequiredDevice::gpu && device.isCpu)
        reasons.emplace_back("--require-device gpu");
    const bool isIndex =
        !config.wanted.empty() && std::all_of(config.wanted.begin(), config.wanted.end(),
                                              [](unsigned char c) { return std::isdigit(c) != 0; });
    if (isIndex && config.wanted != std::to_string(device.index))
        reasons.push_back(fmt::format("its index is not {}", config.wanted));
    if (!isIndex && lowerCase(device.name).find(lowerCase(config.wanted)) == std::string::npos)
        reasons.push_back(fmt::format("its name does not contain \"{}\"", config.wanted));
    return reasons;
}

} // namespace

std::optional<uint32_t> findComputeFamily(const vk::raii::PhysicalDevice& physical) {
    std::optional<uint32_t> found;
    const auto families = physical.getQueueFamilyProperties();
    for (uint32_t i = 0; i < families.size(); ++i) {
        if (!(families[i].queueFlags & vk::QueueFlagBits::eCompute))
            continue;
        if (!found || (families[*found].timestampValidBits == 0 && families[i].timestampValidBits != 0))
            found = i;
    }
    return found;
}

bool hasTexelBuffers(const vk::PhysicalDeviceLimits& limits) {
    return limits.maxTexelBufferElements >= kMinTexelElements &&
           limits.maxPerStageDescriptorSampledImages >= kMostTexelBuffers;
}

std::vector<std::string> whatIsMissing(const vk::PhysicalDeviceLimits& limits,
                                       const vk::PhysicalDeviceSubgroupProperties& subgroup) {
    std::vector<std::string> missing;
    if (!(subgroup.supportedStages & vk::ShaderStageFlagBits::eCompute))
        missing.emplace_back("no subgroup operations in compute shaders");
    const auto operations = vk::SubgroupFeatureFlagBits::eBasic | vk::SubgroupFeatureFlagBits::eBallot;
    if ((subgroup.supportedOperations & operations) != operations)
        missing.emplace_back("no subgroup ballot (needed to compact the queues)");
    const auto require = [&](const char* words, uint64_t there, uint64_t needed) {
        if (there < needed)
            missing.push_back(fmt::format(fmt::runtime(words), there, needed));
    };
    require("{} storage buffers per stage, {} needed", limits.maxPerStageDescriptorStorageBuffers,
            hasTexelBuffers(limits) ? kMostStorageBuffers : kMostStorageBuffers + kMostTexelBuffers);
    require("workgroups of {} invocations at most, {} needed", limits.maxComputeWorkGroupInvocations,
            kWorkgroupSize);
    return missing;
}

DeviceDescription describeDevice(const vk::raii::PhysicalDevice& physical, uint32_t index) {
    const vk::PhysicalDeviceProperties properties = physical.getProperties();
    DeviceDescription description;
    description.index = index;
    description.name = properties.deviceName.data();
    description.type = typeText(properties.deviceType);
    description.isCpu = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    description.apiVersion = versionText(properties.apiVersion);
    description.driver = versionText(properties.driverVersion);
    if (properties.apiVersion < VK_API_VERSION_1_2) {
        description.refusals.push_back(fmt::format("Vulkan {}, 1.2 needed", description.apiVersion));
    } else {
        const auto chain =
            physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties,
                                    vk::PhysicalDeviceSubgroupProperties>();
        const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
        description.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
        description.refusals =
            whatIsMissing(properties.limits, chain.get<vk::PhysicalDeviceSubgroupProperties>());
        description.tracesRays = hasRayQueries(physical);
    }
    if (!findComputeFamily(physical))
        description.refusals.emplace_back("no compute queue");
    return description;
}

uint32_t chooseDevice(const std::vector<DeviceDescription>& devices, const DeviceConfig& config) {
    std::optional<uint32_t> best;
    std::string reasons;
    for (uint32_t i = 0; i < devices.size(); ++i) {
        const std::vector<std::string> refused = unwanted(devices[i], config);
        if (!refused.empty())
            reasons +=
                fmt::format("; {} {}: {}", devices[i].index, devices[i].name, fmt::join(refused, ", "));
        else if (!best || (devices[*best].isCpu && !devices[i].isCpu))
            best = i;
    }
    if (!best)
        throw Error(fmt::format(
            "no usable Vulkan device{}",
            devices.empty() ? ": none found; Debian's mesa-vulkan-drivers has one for CPUs" : reasons));
    return *best;
}

} // namespace lavalight::gpu
