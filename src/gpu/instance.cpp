#include "gpu/instance.h"

#include <array>
#include <mutex>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "gpu/direct_driver.h"
#include "gpu/vulkan_error.h"
#include "gpu/wide_vectors.h"

namespace lavalight::gpu {

// Written by the validation layer from whichever thread makes the call.
struct Instance::MessageLog {
    std::mutex mutex;
    std::vector<std::string> lines;

    static VKAPI_ATTR VkBool32 VKAPI_CALL append(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                 VkDebugUtilsMessageTypeFlagsEXT,
                                                 const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                 void* user) {
        auto* log = static_cast<MessageLog*>(user);
        const std::lock_guard lock(log->mutex);
        log->lines.emplace_back(data->pMessage);
        return VK_FALSE;
    }
};

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

vk::raii::Context makeContext() {
    try {
        return vk::raii::Context();
    } catch (const std::exception& error) {
        throw Error(
            fmt::format("cannot load Vulkan: {}; Debian's packages are libvulkan1 and mesa-vulkan-drivers",
                        error.what()));
    }
}

void requireValidationLayer(const vk::raii::Context& context) {
    for (const vk::LayerProperties& layer : context.enumerateInstanceLayerProperties())
        if (std::string_view(layer.layerName.data()) == kValidationLayer)
            return;
    throw Error(fmt::format("cannot validate: the layer {} is not installed; Debian's package is "
                            "vulkan-validationlayers",
                            kValidationLayer));
}

bool knowsDirectDrivers(const vk::raii::Context& context) {
    for (const vk::ExtensionProperties& extension : context.enumerateInstanceExtensionProperties())
        if (std::string_view(extension.extensionName.data()) ==
            VK_LUNARG_DIRECT_DRIVER_LOADING_EXTENSION_NAME)
            return true;
    return false;
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validate,
                                std::span<const char* const> wanted) {
    const vk::ApplicationInfo application("lavalight", 1, nullptr, 0, VK_API_VERSION_1_2);
    const std::array enabled = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features(enabled);
    const std::array layers = {kValidationLayer};
    std::vector<const char*> extensions(wanted.begin(), wanted.end());
    vk::InstanceCreateInfo info({}, &application);
    if (validate) {
        requireValidationLayer(context);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        info.setPEnabledLayerNames(layers);
        info.setPNext(&features);
    }
    VkDirectDriverLoadingListLUNARG driver{};
    const DriverOffer offer(knowsDirectDrivers(context));
    if (const VkDirectDriverLoadingListLUNARG* own = offer.direct()) {
        extensions.push_back(VK_LUNARG_DIRECT_DRIVER_LOADING_EXTENSION_NAME);
        driver = *own;
        driver.pNext = const_cast<void*>(info.pNext); // C declares it so; it is read alone
        info.setPNext(&driver);
    }
    info.setPEnabledExtensionNames(extensions);
    const auto create = [&] {
        const auto lock = lockLoader();
        return vk::raii::Instance(context, info);
    };
    return checked(
        "create",
        "the Vulkan instance (is a driver installed? Debian's mesa-vulkan-drivers has one for CPUs)", create);
}

// Makes an instance whose lavapipe has the width of vectors that the process keeps.
vk::raii::Instance startDrivers(const vk::raii::Context& context, bool validate,
                                std::span<const char* const> extensions) {
    // No other thread may list devices meanwhile: it would keep those of another width.
    static std::mutex deciding;
    const std::lock_guard alone(deciding);
    keepKernelsByWidth();
    vk::raii::Instance probe = nullptr;
    if (mayUseWideVectors()) {
        probe = makeInstance(context, false, {});
        if (checked("list", "the Vulkan devices", [&] { return gainsByWideVectors(probe); }))
            useWideVectors();
    }
    vk::raii::Instance instance = makeInstance(context, validate, extensions); // while drivers are loaded
    const auto lock = lockLoader();
    probe = nullptr;
    return instance;
}

} // namespace

std::unique_lock<std::mutex> lockLoader() {
    static std::mutex mutex;
    return std::unique_lock(mutex);
}

Instance::Instance(bool validate, std::span<const char* const> extensions)
    : context_(makeContext()), messages_(std::make_unique<MessageLog>()),
      instance_(startDrivers(context_, validate, extensions)) {
    if (!validate)
        return;
    // The C structure: Vulkan-Hpp 1.4 (Debian 13) declares the callback with other types than 1.3.
    const VkDebugUtilsMessengerCreateInfoEXT create{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        nullptr,
        0,
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT,
        VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        &MessageLog::append,
        messages_.get()};
    messenger_ = vk::raii::DebugUtilsMessengerEXT(instance_, vk::DebugUtilsMessengerCreateInfoEXT(create));
}

Instance::~Instance() {
    const auto lock = lockLoader();
    messenger_ = nullptr;
    instance_ = nullptr;
}

std::vector<vk::raii::PhysicalDevice> Instance::physicalDevices() const {
    return checked("list", "the Vulkan devices", [&] {
        std::vector<vk::raii::PhysicalDevice> list;
        for (auto& device : vk::raii::PhysicalDevices(instance_))
            list.push_back(std::move(device));
        return list;
    });
}

std::vector<std::string> Instance::validationMessages() const {
    const std::lock_guard lock(messages_->mutex);
    return messages_->lines;
}

void Instance::requireNoValidationMessages() const {
    const std::vector<std::string> messages = validationMessages();
    if (!messages.empty())
        throw Error(fmt::format("the validation layer has {} messages, the first: {}", messages.size(),
                                messages.front()));
}

} // namespace lavalight::gpu
