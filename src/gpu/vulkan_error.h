// Failures of Vulkan as errors that name the operation and the object.
#pragma once

#include <string_view>

#include <vulkan/vulkan_raii.hpp>

#include "base/error.h"

namespace lavalight::gpu {

// The device is lost: no call of it will succeed any more.
class DeviceLost : public Error {
  public:
    using Error::Error;
};

[[noreturn]] void throwVulkanError(std::string_view operation, std::string_view object,
                                   const vk::SystemError& error);

// Runs a Vulkan operation; a failure becomes an Error that names the operation and the object.
template <typename Operation>
auto checked(std::string_view operation, std::string_view object, const Operation& run) {
    try {
        return run();
    } catch (const vk::SystemError& error) {
        throwVulkanError(operation, object, error);
    }
}

} // namespace lavalight::gpu
