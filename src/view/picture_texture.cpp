#include "view/picture_texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "base/error.h"
#include "gpu/vulkan_error.h"

namespace lavalight {
namespace {

constexpr vk::ImageSubresourceRange kAll(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
constexpr vk::ImageSubresourceLayers kLayer(vk::ImageAspectFlagBits::eColor, 0, 0, 1);

vk::Offset3D corner(const glm::dvec2& at) {
    return {static_cast<int32_t>(at.x), static_cast<int32_t>(at.y), 0};
}

} // namespace

vk::raii::DeviceMemory PictureTexture::memoryFor(const vk::MemoryRequirements& needs,
                                                 vk::MemoryPropertyFlags flags) const {
    const vk::PhysicalDeviceMemoryProperties memory = physical_->getMemoryProperties();
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((needs.memoryTypeBits >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags)
            return {*device_, vk::MemoryAllocateInfo(needs.size, i)};
    throw Error("cannot show a picture: the device has no memory for it");
}

PictureTexture::Store PictureTexture::allocate(const glm::uvec2& size) const {
    using Memory = vk::MemoryPropertyFlagBits;
    const vk::DeviceSize bytes = vk::DeviceSize{4} * size.x * size.y;
    Store store;
    gpu::checked("make", "the window's picture", [&] {
        store.staging = vk::raii::Buffer(*device_, {{}, bytes, vk::BufferUsageFlagBits::eTransferSrc});
        store.stagingMemory =
            memoryFor(store.staging.getMemoryRequirements(), Memory::eHostVisible | Memory::eHostCoherent);
        store.staging.bindMemory(*store.stagingMemory, 0);
        store.mapped = store.stagingMemory.mapMemory(0, bytes);
        store.image = vk::raii::Image(
            *device_,
            vk::ImageCreateInfo({}, vk::ImageType::e2D, vk::Format::eR8G8B8A8Unorm, {size.x, size.y, 1}, 1, 1,
                                vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal,
                                vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst));
        store.imageMemory = memoryFor(store.image.getMemoryRequirements(), Memory::eDeviceLocal);
        store.image.bindMemory(*store.imageMemory, 0);
        return true;
    });
    return store;
}

void PictureTexture::set(const glm::uvec2& size, std::span<const uint32_t> pixels) {
    assert(pixels.size() == size_t{size.x} * size.y && !pixels.empty());
    if (size != size_) {
        store_ = allocate(size);
        size_ = size;
    }
    std::memcpy(store_.mapped, pixels.data(), pixels.size_bytes());
    isUploaded_ = false;
}

void PictureTexture::upload(const vk::raii::CommandBuffer& commands) {
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const vk::ImageMemoryBarrier take({}, Access::eTransferWrite, vk::ImageLayout::eUndefined,
                                      vk::ImageLayout::eTransferDstOptimal, VK_QUEUE_FAMILY_IGNORED,
                                      VK_QUEUE_FAMILY_IGNORED, *store_.image, kAll);
    commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {}, take);
    commands.copyBufferToImage(*store_.staging, *store_.image, vk::ImageLayout::eTransferDstOptimal,
                               vk::BufferImageCopy(0, 0, 0, kLayer, {}, {size_.x, size_.y, 1}));
    const vk::ImageMemoryBarrier give(Access::eTransferWrite, Access::eTransferRead,
                                      vk::ImageLayout::eTransferDstOptimal,
                                      vk::ImageLayout::eTransferSrcOptimal, VK_QUEUE_FAMILY_IGNORED,
                                      VK_QUEUE_FAMILY_IGNORED, *store_.image, kAll);
    commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {}, give);
    isUploaded_ = true;
}

void PictureTexture::draw(const vk::raii::CommandBuffer& commands, const Target& target) {
    if (!isUploaded_)
        upload(commands);
    // At least a pixel, and none beyond the picture, however small the part.
    const glm::dvec2 size(size_);
    const glm::dvec2 scale = size / glm::dvec2(target.window);
    const glm::dvec2 from = glm::min(glm::floor(glm::dvec2(target.from) * scale), size - 1.0);
    const glm::dvec2 to = glm::clamp(glm::ceil(glm::dvec2(target.to) * scale), from + 1.0, size);
    const vk::ImageBlit blit(
        kLayer, {corner(from), {static_cast<int32_t>(to.x), static_cast<int32_t>(to.y), 1}}, kLayer,
        {corner(target.from), {static_cast<int32_t>(target.to.x), static_cast<int32_t>(target.to.y), 1}});
    commands.blitImage(*store_.image, vk::ImageLayout::eTransferSrcOptimal, target.image,
                       vk::ImageLayout::eTransferDstOptimal, blit, vk::Filter::eNearest);
}

} // namespace lavalight
