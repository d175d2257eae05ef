// Draws pictures and an ImGui interface on a window, on a Vulkan device of its own: whatever the renderer's
// device does, the window goes on.
#pragma once

#include <optional>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "gpu/instance.h"
#include "view/live_picture.h"
#include "view/picture_texture.h"
#include "view/swapchain.h"
#include "view/window.h"

namespace lavalight {

class Presenter {
  public:
    // The window must outlive it. Throws Error where no device can draw on the window.
    Presenter(Window& window, bool validate);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Sets what is shown from now on as picture 0 or 1.
    void setPicture(size_t which, const LivePicture& picture);

    // ImGui takes commands between beginFrame() and endFrame(). A window without area is not drawn.
    void beginFrame();
    // Shows picture 0 over the whole window; right of `splitAt`, a share of its width, picture 1.
    void endFrame(float splitAt);

    // Throws Error with the first message of the validation layer.
    void requireNoValidationMessages() const { instance_.requireNoValidationMessages(); }

  private:
    void openDevice();
    void makePass();
    void startOverlay();
    void waitForFrame();
    [[nodiscard]] bool prepareSwapchain();
    void record(const Swapchain::Image& image, float splitAt);
    void drawPictures(const Swapchain::Image& image, float splitAt);
    void submit(const Swapchain::Image& image);

    Window* window_;
    gpu::Instance instance_;
    vk::raii::SurfaceKHR surface_ = nullptr;
    vk::raii::PhysicalDevice physical_ = nullptr;
    uint32_t queueFamily_ = 0;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::SurfaceFormatKHR format_;
    vk::raii::RenderPass pass_ = nullptr;
    vk::raii::CommandPool pool_ = nullptr;
    std::vector<vk::raii::CommandBuffer> commands_; // exactly one
    vk::raii::Semaphore acquired_ = nullptr;
    vk::raii::Fence fence_ = nullptr; // signalled when the frame under way is drawn
    vk::raii::DescriptorPool descriptors_ = nullptr;
    std::optional<Swapchain> swapchain_;
    std::vector<PictureTexture> pictures_; // exactly two
    bool hasOverlay_ = false;
    bool wantsSwapchain_ = false; // the surface needs another swapchain
};

} // namespace lavalight
