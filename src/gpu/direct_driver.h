// A Vulkan driver that the program brings itself, handed to the loader without its being installed.
#pragma once

#include <filesystem>

#include <vulkan/vulkan_core.h>

namespace lavalight::gpu {

// The environment variable that names a driver's library for the whole process, or "system": those of the
// system alone, whatever useDriver() says.
inline constexpr const char* kDriverVariable = "LAVALIGHT_DRIVER";

// Instances that are made from now on know the driver of this library, beside those of the system and before
// them. One for the whole process: a later one takes the place of an earlier one. The library is loaded with
// the first instance.
void useDriver(std::filesystem::path library);

// The driver's part of VkInstanceCreateInfo, for loaders that know VK_LUNARG_direct_driver_loading
// (`knowsDirectDrivers`). Others are given the driver's manifest, a .json file of the same name beside the
// library, by their variable VK_ADD_DRIVER_FILES. None: no driver was named, by useDriver() or
// kDriverVariable, or the loader has the manifest. Throws Error for a library that is not a driver, and for
// one without a manifest where the loader needs it.
[[nodiscard]] const VkDirectDriverLoadingListLUNARG* directDriver(bool knowsDirectDrivers);

} // namespace lavalight::gpu
