#include "view/presenter.h"

#include <algorithm>
#include <limits>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <fmt/format.h>
#include <imgui.h>

#include "base/error.h"
#include "gpu/vulkan_error.h"

namespace lavalight {
namespace {

using Stage = vk::PipelineStageFlagBits;
using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;

constexpr vk::ImageSubresourceRange kWholeColor(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);

std::span<const char* const> surfaceExtensions() {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {names, count};
}

vk::raii::SurfaceKHR makeSurface(const vk::raii::Instance& instance, GLFWwindow* window) {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(*instance, window, nullptr, &surface) != VK_SUCCESS)
        throw Error("cannot draw on this window: Vulkan makes no surface of it");
    return {instance, surface};
}

bool hasSwapchains(const vk::raii::PhysicalDevice& physical) {
    const auto extensions = physical.enumerateDeviceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(), [](const vk::ExtensionProperties& extension) {
        return std::string_view(extension.extensionName.data()) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    });
}

// A family of queues that draws and shows what it drew on the surface.
std::optional<uint32_t> findFamily(const vk::raii::PhysicalDevice& physical, vk::SurfaceKHR surface) {
    const auto families = physical.getQueueFamilyProperties();
    for (uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & vk::QueueFlagBits::eGraphics) &&
            physical.getSurfaceSupportKHR(i, surface) == VK_TRUE)
            return i;
    return std::nullopt;
}

void requireSuccess(VkResult result) {
    if (result != VK_SUCCESS)
        throw Error(fmt::format("cannot draw the window: {}", vk::to_string(vk::Result(result))));
}

vk::ImageMemoryBarrier barrier(vk::Image image, std::pair<vk::AccessFlags, vk::AccessFlags> accesses,
                               std::pair<Layout, Layout> layouts) {
    return {accesses.first,          accesses.second,         layouts.first, layouts.second,
            VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,         kWholeColor};
}

} // namespace

Presenter::Presenter(Window& window, bool validate)
    : window_(&window), instance_(validate, surfaceExtensions()),
      surface_(makeSurface(instance_.handle(), window.handle())) {
    openDevice();
    format_ = chooseSurfaceFormat(physical_, *surface_);
    makePass();
    gpu::checked("prepare", "the window", [&] {
        pool_ = vk::raii::CommandPool(device_,
                                      {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, queueFamily_});
        commands_ = vk::raii::CommandBuffers(device_, {*pool_, vk::CommandBufferLevel::ePrimary, 1});
        acquired_ = vk::raii::Semaphore(device_, vk::SemaphoreCreateInfo());
        fence_ = vk::raii::Fence(device_, {vk::FenceCreateFlagBits::eSignaled});
        return true;
    });
    for (int i = 0; i < 2; ++i)
        pictures_.emplace_back(physical_, device_);
    startOverlay();
}

Presenter::~Presenter() {
    try {
        device_.waitIdle();
    } catch (const vk::SystemError&) { // a lost device is idle enough
    }
    if (hasOverlay_) {
        ImGui_ImplVulkan_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
}

void Presenter::openDevice() {
    std::string refused;
    for (vk::raii::PhysicalDevice& candidate : instance_.physicalDevices()) {
        const auto family = findFamily(candidate, *surface_);
        if (family && hasSwapchains(candidate)) {
            queueFamily_ = *family;
            physical_ = std::move(candidate);
            break;
        }
        refused += fmt::format(" {};", candidate.getProperties().deviceName.data());
    }
    if (*physical_ == vk::PhysicalDevice())
        throw Error(fmt::format("cannot draw on this window: no Vulkan device shows pictures on it; asked:{}",
                                refused.empty() ? " none there" : refused));
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, queueFamily_, 1, &priority);
    const char* extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    vk::DeviceCreateInfo info({}, queue);
    info.setPEnabledExtensionNames(extension);
    device_ = gpu::checked("open", physical_.getProperties().deviceName.data(), [&] {
        const auto lock = gpu::lockLoader();
        return vk::raii::Device(physical_, info);
    });
    queue_ = vk::raii::Queue(device_, queueFamily_, 0);
}

// The interface over pictures that are there already.
void Presenter::makePass() {
    vk::AttachmentDescription window;
    window.format = format_.format;
    window.loadOp = vk::AttachmentLoadOp::eLoad;
    window.storeOp = vk::AttachmentStoreOp::eStore;
    window.stencilLoadOp = vk::AttachmentLoadOp::eDontCare;
    window.stencilStoreOp = vk::AttachmentStoreOp::eDontCare;
    window.initialLayout = Layout::eColorAttachmentOptimal;
    window.finalLayout = Layout::ePresentSrcKHR;
    const vk::AttachmentReference reference(0, Layout::eColorAttachmentOptimal);
    vk::SubpassDescription subpass;
    subpass.setColorAttachments(reference);
    pass_ = gpu::checked("prepare", "the window", [&] {
        return vk::raii::RenderPass(device_, vk::RenderPassCreateInfo({}, window, subpass));
    });
}

void Presenter::startOverlay() {
    const vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 1); // the letters
    descriptors_ =
        vk::raii::DescriptorPool(device_, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size});
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // leaves no file where it was started
    ImGui_ImplGlfw_InitForVulkan(window_->handle(), true);
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = *instance_.handle();
    info.PhysicalDevice = *physical_;
    info.Device = *device_;
    info.QueueFamily = queueFamily_;
    info.Queue = *queue_;
    info.DescriptorPool = *descriptors_;
    info.MinImageCount = 2;
    info.ImageCount = 2;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = requireSuccess;
    ImGui_ImplVulkan_Init(&info, *pass_);
    hasOverlay_ = true;
#if IMGUI_VERSION_NUM >= 19000
    ImGui_ImplVulkan_CreateFontsTexture(); // it submits a command buffer of its own
#else
    const vk::raii::CommandBuffer& commands = commands_.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    ImGui_ImplVulkan_CreateFontsTexture(*commands);
    commands.end();
    const vk::CommandBuffer handle = *commands;
    queue_.submit(vk::SubmitInfo({}, {}, handle));
    queue_.waitIdle();
    ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

void Presenter::waitForFrame() {
    gpu::checked("wait for", "the window", [&] {
        return device_.waitForFences(*fence_, VK_TRUE, std::numeric_limits<uint64_t>::max());
    });
}

void Presenter::setPicture(size_t which, const LivePicture& picture) {
    waitForFrame();
    pictures_[which].set({picture.width, picture.height}, picture.pixels);
}

void Presenter::beginFrame() {
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Presenter::endFrame(float splitAt) {
    ImGui::Render();
    waitForFrame();
    if (!prepareSwapchain())
        return;
    const auto image = swapchain_->acquire(*acquired_);
    if (!image) {
        wantsSwapchain_ = true;
        return;
    }
    device_.resetFences(*fence_);
    record(*image, splitAt);
    submit(*image);
    wantsSwapchain_ = !swapchain_->present(queue_, *image);
}

// False while there is nothing to draw on.
bool Presenter::prepareSwapchain() {
    const glm::uvec2 pixels = window_->pixels();
    if (pixels.x == 0 || pixels.y == 0)
        return false;
    if (swapchain_ && !wantsSwapchain_ && swapchain_->pixels() == pixels)
        return true;
    gpu::checked("wait for", "the window", [&] {
        device_.waitIdle();
        return true;
    });
    const Swapchain::Place place{physical_, device_, *surface_, format_, *pass_};
    Swapchain next(place, pixels, swapchain_ ? swapchain_->handle() : vk::SwapchainKHR());
    swapchain_.reset();
    swapchain_.emplace(std::move(next));
    ImGui_ImplVulkan_SetMinImageCount(swapchain_->imageCount());
    wantsSwapchain_ = false;
    return true;
}

void Presenter::drawPictures(const Swapchain::Image& image, float splitAt) {
    const vk::raii::CommandBuffer& commands = commands_.front();
    const glm::uvec2 window = swapchain_->pixels();
    const bool isSplit = splitAt < 1.0f && !pictures_[1].isEmpty();
    const uint32_t split = isSplit ? static_cast<uint32_t>(splitAt * static_cast<float>(window.x)) : window.x;
    if (pictures_[0].isEmpty())
        commands.clearColorImage(image.image, Layout::eTransferDstOptimal, vk::ClearColorValue(),
                                 kWholeColor);
    else if (split > 0)
        pictures_[0].draw(commands, {image.image, window, {0, 0}, {split, window.y}});
    if (isSplit && split < window.x)
        pictures_[1].draw(commands, {image.image, window, {split, 0}, window});
}

void Presenter::record(const Swapchain::Image& image, float splitAt) {
    const vk::raii::CommandBuffer& commands = commands_.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {},
                             barrier(image.image, {{}, Access::eTransferWrite},
                                     {Layout::eUndefined, Layout::eTransferDstOptimal}));
    drawPictures(image, splitAt);
    commands.pipelineBarrier(
        Stage::eTransfer, Stage::eColorAttachmentOutput, {}, {}, {},
        barrier(image.image,
                {Access::eTransferWrite, Access::eColorAttachmentRead | Access::eColorAttachmentWrite},
                {Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal}));
    const glm::uvec2 size = swapchain_->pixels();
    commands.beginRenderPass(vk::RenderPassBeginInfo(*pass_, image.framebuffer, {{0, 0}, {size.x, size.y}}),
                             vk::SubpassContents::eInline);
    // What throws while it lets its buffers grow has freed the old ones, and would do so again at its
    // shutdown.
    hasOverlay_ = false;
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), *commands);
    hasOverlay_ = true;
    commands.endRenderPass();
    commands.end();
}

void Presenter::submit(const Swapchain::Image& image) {
    const vk::CommandBuffer commands = *commands_.front();
    const vk::Semaphore acquired = *acquired_;
    const vk::PipelineStageFlags waitsAt = Stage::eTransfer;
    gpu::checked("draw", "the window", [&] {
        queue_.submit(vk::SubmitInfo(acquired, waitsAt, commands, image.drawn), *fence_);
        return true;
    });
}

} // namespace lavalight
