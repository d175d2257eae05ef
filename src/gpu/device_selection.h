// Which Vulkan devices can render, which cannot and why, and which one to take.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "gpu/device.h"

namespace lavalight::gpu {

// What `physical` is and every reason why it cannot render.
[[nodiscard]] DeviceDescription describeDevice(const vk::raii::PhysicalDevice& physical, uint32_t index);

// Most buffers of a kind that one kernel declares (a test looks at all kernels). Every Vulkan device allows
// as many texel buffers.
constexpr uint32_t kMostStorageBuffers = 8;
constexpr uint32_t kMostTexelBuffers = 16;

// What a device needs where kernels are to ask it about rays.
constexpr std::array<const char*, 3> kRayExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                                    VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                                    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

// Whether texel buffers of the device are as many and as large as scenes ask for. Where they are not, storage
// buffers take their place.
[[nodiscard]] bool hasTexelBuffers(const vk::PhysicalDeviceLimits& limits);

// Why a device of these properties cannot run the kernels, a phrase each.
[[nodiscard]] std::vector<std::string> whatIsMissing(const vk::PhysicalDeviceLimits& limits,
                                                     const vk::PhysicalDeviceSubgroupProperties& subgroup);

// The queue family for compute work that also has timestamps where possible; nullopt: none computes.
[[nodiscard]] std::optional<uint32_t> findComputeFamily(const vk::raii::PhysicalDevice& physical);

// Index into `devices` by the wishes of `config`: GPUs before CPUs. Throws Error with each device's reasons.
[[nodiscard]] uint32_t chooseDevice(const std::vector<DeviceDescription>& devices,
                                    const DeviceConfig& config);

} // namespace lavalight::gpu
