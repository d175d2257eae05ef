// The Vulkan instance, with or without the validation layer and what that says.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

namespace lavalight::gpu {

// Held while an instance or a device is made or destroyed. Vulkan promises that threads may do so at the same
// time, but the loader's list of devices has no lock of its own (KhronosGroup/Vulkan-Loader#2018): on Debian
// 13 two sessions that opened their devices together crashed.
[[nodiscard]] std::unique_lock<std::mutex> lockLoader();

class Instance {
  public:
    // `validate` adds the Khronos validation layer and its checks of synchronisation. Throws Error where
    // there is no Vulkan loader, driver, layer or extension of that name.
    explicit Instance(bool validate, std::span<const char* const> extensions = {});
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] const vk::raii::Instance& handle() const { return instance_; }
    [[nodiscard]] std::vector<vk::raii::PhysicalDevice> physicalDevices() const;

    // What the validation layer said so far, oldest first. Empty without `validate`.
    [[nodiscard]] std::vector<std::string> validationMessages() const;
    // Throws Error with the first of these messages, if there is any.
    void requireNoValidationMessages() const;

  private:
    struct MessageLog;

    vk::raii::Context context_;
    std::unique_ptr<MessageLog> messages_; // at a fixed address: the messenger's callback writes to it
    vk::raii::Instance instance_;
    vk::raii::DebugUtilsMessengerEXT messenger_ = nullptr;
};

} // namespace lavalight::gpu
