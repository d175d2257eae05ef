// The images of a window, in turn.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>
#include <vulkan/vulkan_raii.hpp>

namespace lavalight {

// 8 bits a channel that are shown as they are, not converted to sRGB, if the surface has such. Throws Error.
[[nodiscard]] vk::SurfaceFormatKHR chooseSurfaceFormat(const vk::raii::PhysicalDevice& physical,
                                                       vk::SurfaceKHR surface);

class Swapchain {
  public:
    struct Place {
        const vk::raii::PhysicalDevice& physical;
        const vk::raii::Device& device;
        vk::SurfaceKHR surface;
        vk::SurfaceFormatKHR format;
        vk::RenderPass pass; // with which framebuffers are made
    };

    // For a window of that many pixels, neither of them 0. `before` is what it takes the place of, or null.
    Swapchain(const Place& place, const glm::uvec2& pixels, vk::SwapchainKHR before);

    struct Image {
        uint32_t index = 0;
        vk::Image image;
        vk::Framebuffer framebuffer;
        vk::Semaphore drawn; // to be signalled when it is
    };
    // Waits for an image; `ready` is signalled once it may be drawn on. Nothing: the window has changed, and
    // wants another swapchain.
    [[nodiscard]] std::optional<Image> acquire(vk::Semaphore ready);
    // Shows it; false: the window wants another swapchain.
    [[nodiscard]] bool present(const vk::raii::Queue& queue, const Image& image);

    [[nodiscard]] const glm::uvec2& pixels() const { return pixels_; }
    [[nodiscard]] uint32_t imageCount() const { return static_cast<uint32_t>(images_.size()); }
    [[nodiscard]] vk::SwapchainKHR handle() const { return *swapchain_; }

  private:
    void makeFramebuffer(const Place& place, vk::Image image);

    glm::uvec2 pixels_;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    std::vector<vk::Image> images_;
    std::vector<vk::raii::ImageView> views_;
    std::vector<vk::raii::Framebuffer> framebuffers_;
    std::vector<vk::raii::Semaphore> drawn_; // of each image: free again once it is acquired again
};

} // namespace lavalight
