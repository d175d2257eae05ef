// Vulkan-Loader, "Driver interface to the Loader", version 7: the loader asks such a driver for everything
// through one function. Drivers of version 5 export the same functions, which directDriverProc() looks up.
#include "gpu/direct_driver.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <utility>

#include <dlfcn.h>
#include <fmt/format.h>
#include <vulkan/vk_icd.h>

#include "base/error.h"
#include "base/os/environment.h"

namespace lavalight::gpu {
namespace {

constexpr uint32_t kVersionWithOneDoor = 7;

struct DirectDriver {
    std::mutex mutex;
    std::filesystem::path wanted;
    std::filesystem::path loaded;
    void* library = nullptr; // stays loaded: devices may outlive whatever asked for them
    PFN_vkGetInstanceProcAddr instanceProc = nullptr;
    PFN_vkNegotiateLoaderICDInterfaceVersion negotiate = nullptr;
    VkDirectDriverLoadingInfoLUNARG info{};
    VkDirectDriverLoadingListLUNARG list{};
};

DirectDriver& theDriver() {
    static DirectDriver driver;
    return driver;
}

template <class Function>
Function symbol(void* library, const char* name) {
    return reinterpret_cast<Function>(dlsym(library, name));
}

VKAPI_ATTR VkResult VKAPI_CALL negotiateVersion(uint32_t* version) {
    const uint32_t loaders = *version;
    const VkResult result = theDriver().negotiate(version);
    if (result == VK_SUCCESS && *version < kVersionWithOneDoor)
        *version = std::min(loaders, kVersionWithOneDoor); // the one door is directDriverProc()
    return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL directDriverProc(VkInstance instance, const char* name) {
    const std::string_view wanted(name);
    if (wanted == "vk_icdNegotiateLoaderICDInterfaceVersion")
        return reinterpret_cast<PFN_vkVoidFunction>(&negotiateVersion);
    if (wanted.starts_with("vk_icd"))
        return symbol<PFN_vkVoidFunction>(theDriver().library, name);
    return theDriver().instanceProc(instance, name);
}

void load(DirectDriver& driver) {
    const std::string path = driver.wanted.string();
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        throw Error(fmt::format("cannot load the Vulkan driver {}: {}", path, dlerror()));
    const auto instanceProc = symbol<PFN_vkGetInstanceProcAddr>(library, "vk_icdGetInstanceProcAddr");
    const auto negotiate =
        symbol<PFN_vkNegotiateLoaderICDInterfaceVersion>(library, "vk_icdNegotiateLoaderICDInterfaceVersion");
    if (instanceProc == nullptr || negotiate == nullptr) {
        dlclose(library);
        throw Error(
            fmt::format("cannot use {} as a Vulkan driver: it does not export what drivers do", path));
    }
    driver.library = library;
    driver.instanceProc = instanceProc;
    driver.negotiate = negotiate;
    driver.info = {VK_STRUCTURE_TYPE_DIRECT_DRIVER_LOADING_INFO_LUNARG, nullptr, 0, &directDriverProc};
    driver.list = {VK_STRUCTURE_TYPE_DIRECT_DRIVER_LOADING_LIST_LUNARG, nullptr,
                   VK_DIRECT_DRIVER_LOADING_MODE_INCLUSIVE_LUNARG, 1, &driver.info};
    driver.loaded = driver.wanted;
}

std::string manifestOf(const std::filesystem::path& library) {
    std::filesystem::path manifest = library;
    manifest.replace_extension(".json");
    if (!std::filesystem::exists(manifest))
        throw Error(
            fmt::format("cannot hand the driver {} to this Vulkan loader, which is older than 1.3.243: "
                        "{} is missing; try the loader's own VK_ADD_DRIVER_FILES",
                        library.string(), manifest.string()));
    return manifest.string();
}

bool hasNamedManifests() {
    for (const char* variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"})
        if (environmentVariable(variable))
            return true;
    return false;
}

} // namespace

void useDriver(std::filesystem::path library) {
    DirectDriver& driver = theDriver();
    const std::lock_guard lock(driver.mutex);
    driver.wanted = std::move(library);
}

DriverOffer::DriverOffer(bool knowsDirectDrivers) {
    DirectDriver& driver = theDriver();
    const std::lock_guard lock(driver.mutex);
    const std::optional<std::string> named = environmentVariable(kDriverVariable);
    if (named == "system")
        return;
    if (named)
        driver.wanted = *named;
    if (driver.wanted.empty())
        return;
    if (driver.wanted != driver.loaded)
        load(driver);
    if (knowsDirectDrivers)
        direct_ = &driver.list;
    else
        prepend("VK_ADD_DRIVER_FILES", manifestOf(driver.wanted), ':');
    if (!hasNamedManifests())                                  // those are the user's wish
        prepend("VK_LOADER_DRIVERS_DISABLE", "lvp_icd*", ','); // the names of Mesa's manifests
}

DriverOffer::~DriverOffer() {
    for (const auto& [variable, value] : before_)
        value ? ::setenv(variable, value->c_str(), 1) : ::unsetenv(variable);
}

void DriverOffer::prepend(const char* variable, const std::string& value, char separator) {
    const char* others = std::getenv(variable);
    before_.emplace_back(variable, others == nullptr ? std::nullopt : std::optional<std::string>(others));
    ::setenv(variable, (others == nullptr ? value : value + separator + others).c_str(), 1);
}

} // namespace lavalight::gpu
