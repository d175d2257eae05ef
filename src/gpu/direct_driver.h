// A Vulkan driver that the program brings itself, handed to the loader without its being installed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace lavalight::gpu {

// The environment variable that names a driver's library for the whole process, or "system": those of the
// system alone, whatever useDriver() says.
inline constexpr const char* kDriverVariable = "LAVALIGHT_DRIVER";

// Instances that are made from now on know the driver of this library beside those of the system, but in
// place of the system's lavapipe: both would be there for the same work, with other bits. One for the whole
// process: a later one takes the place of an earlier one. The library is loaded with the first instance.
void useDriver(std::filesystem::path library);

// What the loader is told of the named driver while an instance is made. Variables of the loader's are as
// they were before once that is done: programs that this one starts have drivers of their own.
class DriverOffer {
  public:
    // For loaders that know VK_LUNARG_direct_driver_loading (`knowsDirectDrivers`). Others are given the
    // driver's manifest, a .json file of the same name beside the library. Throws Error for a library that is
    // not a driver, and for one without a manifest where the loader needs it.
    explicit DriverOffer(bool knowsDirectDrivers);
    ~DriverOffer();
    DriverOffer(const DriverOffer&) = delete;
    DriverOffer& operator=(const DriverOffer&) = delete;

    // The driver's part of VkInstanceCreateInfo. None: no driver was named, by useDriver() or
    // kDriverVariable, or the loader has the manifest.
    [[nodiscard]] const VkDirectDriverLoadingListLUNARG* direct() const { return direct_; }

  private:
    void prepend(const char* variable, const std::string& value, char separator);

    const VkDirectDriverLoadingListLUNARG* direct_ = nullptr;
    std::vector<std::pair<const char*, std::optional<std::string>>> before_;
};

} // namespace lavalight::gpu
