#include "gpu/wide_vectors.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "base/os/environment.h"

namespace lavalight::gpu {
namespace {

constexpr const char* kWidth = "LP_NATIVE_VECTOR_WIDTH";
constexpr const char* kCacheFolder = "MESA_SHADER_CACHE_DIR";
constexpr const char* kNoCache = "MESA_SHADER_CACHE_DISABLE";
constexpr int kFirstMesa = 25;

std::atomic<bool> isAllowed = false;

// Mesa's major version, or 0 where the text names none.
int mesaVersion(std::string_view info) {
    constexpr std::string_view kMesa = "Mesa ";
    int version = 0;
    if (info.starts_with(kMesa))
        std::from_chars(info.data() + kMesa.size(), info.data() + info.size(), version);
    return version;
}

bool isProcessor(const vk::raii::PhysicalDevice& device) {
    return device.getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
}

bool gains(const vk::raii::PhysicalDevice& device) {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    if (properties.apiVersion < VK_API_VERSION_1_2)
        return false;
    const auto chain =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    return driver.driverID == vk::DriverId::eMesaLlvmpipe &&
           gainsByWideVectors(driver.driverInfo.data(), properties.deviceName.data(),
                              processorHasWideVectors());
}

// Where Mesa would put its cache, for users that have a home.
std::optional<std::filesystem::path> mesaCacheHome() {
    for (const char* variable : {kCacheFolder, "XDG_CACHE_HOME"})
        if (auto named = environmentPath(variable))
            return named;
    const auto home = environmentPath("HOME");
    return home ? std::optional(*home / ".cache") : std::nullopt;
}

// Makes a folder of that name where Mesa would put its cache. None where that fails.
std::optional<std::filesystem::path> makeCacheFolder(const std::string& name) {
    std::optional<std::filesystem::path> home = mesaCacheHome();
    if (!home || home->filename() == name) // an earlier call, or the parent process, has made it
        return home;
    std::error_code error;
    std::filesystem::create_directories(*home / name, error);
    return error ? std::nullopt : std::optional(*home / name);
}

} // namespace

bool processorHasWideVectors() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi2");
#else
    return false;
#endif
}

bool gainsByWideVectors(std::string_view info, std::string_view name, bool processorHasThem) {
    return processorHasThem && mesaVersion(info) >= kFirstMesa &&
           name.find("256 bits") != std::string_view::npos;
}

void allowWideVectors() {
    isAllowed = true;
}

bool mayUseWideVectors() {
    return isAllowed && processorHasWideVectors() && !environmentVariable(kWidth) && mesaCacheHome();
}

bool gainsByWideVectors(const vk::raii::Instance& instance) {
    const vk::raii::PhysicalDevices devices(instance);
    return std::ranges::all_of(devices, isProcessor) && std::ranges::any_of(devices, gains);
}

void useWideVectors() {
    ::setenv(kWidth, "512", 1);
    keepKernelsByWidth();
}

void keepKernelsByWidth() {
    const std::optional<std::string> width = environmentVariable(kWidth);
    if (!width || environmentVariable(kNoCache) == "true")
        return;
    const auto folder = makeCacheFolder("lavapipe-" + *width + "-bits");
    if (!folder)
        ::setenv(kNoCache, "true", 1);
    else if (folder != environmentPath(kCacheFolder))
        ::setenv(kCacheFolder, folder->c_str(), 1);
}

} // namespace lavalight::gpu
