#include "gpu/vulkan_error.h"

#include <string>

#include <fmt/format.h>

namespace lavalight::gpu {

void throwVulkanError(std::string_view operation, std::string_view object, const vk::SystemError& error) {
    const std::string message = fmt::format("cannot {} {}: {}", operation, object, error.what());
    if (error.code() == vk::Result::eErrorDeviceLost)
        throw DeviceLost(message);
    throw Error(message);
}

} // namespace lavalight::gpu
