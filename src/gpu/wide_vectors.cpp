#include "gpu/wide_vectors.h"

#include <algorithm>
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
constexpr int kFirstMesa = 25;

// 0 where the text does not say.
int mesaVersion(std::string_view info) {
    constexpr std::string_view kMesa = "Mesa ";
    int version = 0;
    if (info.starts_with(kMesa))
        std::from_chars(info.data() + kMesa.size(), info.data() + info.size(), version);
    return version;
}

// Those of Ice Lake, Zen 4 and later. Earlier ones lower their clock for 512 bits.
bool processorHasWideVectors() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi2");
#else
    return false;
#endif
}

bool gains(const vk::raii::PhysicalDevice& device) {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    if (properties.deviceType != vk::PhysicalDeviceType::eCpu || properties.apiVersion < VK_API_VERSION_1_2)
        return false;
    const auto chain =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    return driver.driverID == vk::DriverId::eMesaLlvmpipe &&
           gainsByWideVectors(driver.driverInfo.data(), properties.deviceName.data(),
                              processorHasWideVectors());
}

// The folder where Mesa makes the one of its cache.
std::optional<std::filesystem::path> mesaCacheHome() {
    if (const auto named = environmentPath(kCacheFolder))
        return named;
    if (const auto cache = environmentPath("XDG_CACHE_HOME"))
        return cache;
    const auto home = environmentPath("HOME");
    return home ? std::optional(*home / ".cache") : std::nullopt;
}

// A folder of that name where Mesa's cache is. None where it cannot be made.
std::optional<std::filesystem::path> makeCacheFolder(const std::string& name) {
    const std::optional<std::filesystem::path> home = mesaCacheHome();
    if (!home || home->filename() == name) // set by the process that started this one
        return home;
    std::error_code error;
    std::filesystem::create_directories(*home / name, error);
    return error ? std::nullopt : std::optional(*home / name);
}

} // namespace

bool gainsByWideVectors(std::string_view info, std::string_view name, bool processorHasThem) {
    return processorHasThem && mesaVersion(info) >= kFirstMesa &&
           name.find("256 bits") != std::string_view::npos;
}

bool gainsByWideVectors(const vk::raii::Instance& instance) {
    return processorHasWideVectors() && !environmentVariable(kWidth) &&
           std::ranges::any_of(vk::raii::PhysicalDevices(instance), gains);
}

void useWideVectors() {
    ::setenv(kWidth, "512", 1);
    keepKernelsByWidth();
}

void keepKernelsByWidth() {
    const std::optional<std::string> width = environmentVariable(kWidth);
    if (!width)
        return;
    const auto folder = makeCacheFolder("lavapipe-" + *width + "-bits");
    if (!folder)
        ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    else if (folder != environmentPath(kCacheFolder))
        ::setenv(kCacheFolder, folder->c_str(), 1);
}

} // namespace lavalight::gpu
