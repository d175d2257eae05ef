// A Vulkan driver that the program brings itself, handed to the loader without its being installed.
#pragma once

#include <filesystem>

#include <vulkan/vulkan_core.h>

namespace lavalight::gpu {

// The environment variable that names a driver's library for the whole process.
inline constexpr const char* kDriverVariable = "LAVALIGHT_DRIVER";

// Instances that are made from now on know the driver of this library, beside those of the system and before
// them. One for the whole process: a later one takes the place of an earlier one. The library is loaded with
// the first instance.
void useDriver(std::filesystem::path library);

// The driver's part of VkInstanceCreateInfo: VK_LUNARG_direct_driver_loading. None: no driver was named, by
// useDriver() or kDriverVariable. Throws Error for a library that is not a driver.
[[nodiscard]] const VkDirectDriverLoadingListLUNARG* directDriver();

} // namespace lavalight::gpu
