#include "gpu/wide_vectors.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/user_cache.h"

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

bool processorHasWideVectors() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

// Beside the kernels of other widths.
std::optional<std::filesystem::path> cacheOfWideKernels() {
    constexpr const char* kName = "mesa-512-bits";
    if (const std::optional<std::filesystem::path> users = environmentPath(kCacheFolder))
        return *users / kName;
    return userCacheFolder(kName);
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

} // namespace

bool gainsByWideVectors(std::string_view info, std::string_view name, bool processorHasThem) {
    return processorHasThem && mesaVersion(info) >= kFirstMesa &&
           name.find("256 bits") != std::string_view::npos;
}

bool gainsByWideVectors(const vk::raii::Instance& instance) {
    return !environmentVariable(kWidth) && cacheOfWideKernels() &&
           std::ranges::any_of(vk::raii::PhysicalDevices(instance), gains);
}

void askForWideVectors(VariablesForNow& variables) {
    const std::optional<std::filesystem::path> cache = cacheOfWideKernels();
    if (!cache)
        return;
    variables.set(kWidth, "512");
    variables.set(kCacheFolder, cache->string());
}

} // namespace lavalight::gpu
