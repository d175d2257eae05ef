// The images of a window, in turn.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>
#include <vulkan/vulkan_raii.hpp>

namespace lavalight {

// A format of 8 bits a channel that are shown as they are, not converted to sRGB, if the surface has one.
// Throws Error.
[[nodiscard]] vk::SurfaceFormatKHR chooseSurfaceFormat(const vk::raii::PhysicalDevice& physical,
                                                       vk::SurfaceKHR surface);

class Swapchain {
  public:
    struct Place {
        const vk::raii::PhysicalDevice& physical;
        const vk::raii::Device& device;
        vk::SurfaceKHR surface;
        vk::SurfaceFormatKHR format;
        vk::RenderPass pass; // the pass that framebuffers are made for
    };

    // For a window of that many pixels, neither number 0. Takes the place of `before`, which may be null.
    Swapchain(const Place& place, const glm::uvec2& pixels, vk::SwapchainKHR before);

    struct Image {
        uint32_t index = 0;
        vk::Image image;
        vk::Framebuffer framebuffer;
        vk::Semaphore drawn; // to be signalled when the image is drawn
    };
    // Waits for an image; `ready` is signalled once it may be drawn on. Returns nothing if the window has
    // changed and wants another swapchain.
    [[nodiscard]] std::optional<Image> acquire(vk::Semaphore ready);
    // Shows the image; false: the window wants another swapchain.
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
    std::vector<vk::raii::Semaphore>
        drawn_; // one for each image, free again once the image is acquired again
};

} // namespace lavalight
