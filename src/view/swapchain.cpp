#include "view/swapchain.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "gpu/vulkan_error.h"

namespace lavalight {
namespace {

// The mode that shows the newest picture first, without tearing, where the surface can; waiting for the
// screen is always possible.
vk::PresentModeKHR choosePresentMode(const vk::raii::PhysicalDevice& physical, vk::SurfaceKHR surface) {
    const auto modes = physical.getSurfacePresentModesKHR(surface);
    const bool hasMailbox =
        std::find(modes.begin(), modes.end(), vk::PresentModeKHR::eMailbox) != modes.end();
    return hasMailbox ? vk::PresentModeKHR::eMailbox : vk::PresentModeKHR::eFifo;
}

uint32_t chooseImageCount(const vk::SurfaceCapabilitiesKHR& can) {
    const uint32_t most = can.maxImageCount == 0 ? std::numeric_limits<uint32_t>::max() : can.maxImageCount;
    return std::min(std::max(can.minImageCount + 1, 2u), most);
}

// The size that the surface states, unless it leaves that to us.
vk::Extent2D chooseExtent(const vk::SurfaceCapabilitiesKHR& can, const glm::uvec2& pixels) {
    if (can.currentExtent.width != std::numeric_limits<uint32_t>::max())
        return can.currentExtent;
    return {std::clamp(pixels.x, can.minImageExtent.width, can.maxImageExtent.width),
            std::clamp(pixels.y, can.minImageExtent.height, can.maxImageExtent.height)};
}

} // namespace

vk::SurfaceFormatKHR chooseSurfaceFormat(const vk::raii::PhysicalDevice& physical, vk::SurfaceKHR surface) {
    const auto formats = physical.getSurfaceFormatsKHR(surface);
    const auto isPlain = [](const vk::SurfaceFormatKHR& format) {
        return format.format == vk::Format::eB8G8R8A8Unorm || format.format == vk::Format::eR8G8B8A8Unorm;
    };
    const auto found = std::find_if(formats.begin(), formats.end(), isPlain);
    if (found == formats.end())
        throw Error("cannot draw on this window: it takes no picture of 8 bits a channel without conversion");
    return *found;
}

Swapchain::Swapchain(const Place& place, const glm::uvec2& pixels, vk::SwapchainKHR before) {
    const auto can = place.physical.getSurfaceCapabilitiesKHR(place.surface);
    const vk::Extent2D extent = chooseExtent(can, pixels);
    pixels_ = {extent.width, extent.height};
    vk::SwapchainCreateInfoKHR info;
    info.surface = place.surface;
    info.minImageCount = chooseImageCount(can);
    info.imageFormat = place.format.format;
    info.imageColorSpace = place.format.colorSpace;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferDst;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = vk::CompositeAlphaFlagBitsKHR::eOpaque;
    info.presentMode = choosePresentMode(place.physical, place.surface);
    info.clipped = VK_TRUE;
    info.oldSwapchain = before;
    gpu::checked("make", "the window's images", [&] {
        swapchain_ = vk::raii::SwapchainKHR(place.device, info);
        for (const VkImage image : swapchain_.getImages())
            makeFramebuffer(place, image);
        return true;
    });
}

void Swapchain::makeFramebuffer(const Place& place, vk::Image image) {
    images_.push_back(image);
    const vk::ImageSubresourceRange all(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
    views_.emplace_back(place.device, vk::ImageViewCreateInfo({}, image, vk::ImageViewType::e2D,
                                                              place.format.format, {}, all));
    const vk::ImageView view = *views_.back();
    framebuffers_.emplace_back(place.device,
                               vk::FramebufferCreateInfo({}, place.pass, view, pixels_.x, pixels_.y, 1));
    drawn_.emplace_back(place.device, vk::SemaphoreCreateInfo());
}

std::optional<Swapchain::Image> Swapchain::acquire(vk::Semaphore ready) {
    try {
        const uint32_t index =
            swapchain_.acquireNextImage(std::numeric_limits<uint64_t>::max(), ready).second;
        return Image{index, images_[index], *framebuffers_[index], *drawn_[index]};
    } catch (const vk::OutOfDateKHRError&) {
        return std::nullopt;
    } catch (const vk::SystemError& error) {
        gpu::throwVulkanError("draw on", "the window", error);
    }
}

bool Swapchain::present(const vk::raii::Queue& queue, const Image& image) {
    const vk::SwapchainKHR swapchain = *swapchain_;
    try {
        return queue.presentKHR(vk::PresentInfoKHR(image.drawn, swapchain, image.index)) ==
               vk::Result::eSuccess;
    } catch (const vk::OutOfDateKHRError&) {
        return false;
    } catch (const vk::SystemError& error) {
        gpu::throwVulkanError("show", "the window", error);
    }
}

} // namespace lavalight
