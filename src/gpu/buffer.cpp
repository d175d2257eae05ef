#include "gpu/buffer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "gpu/commands.h"

namespace lavalight::gpu {
namespace {

constexpr uint64_t kTexelBytes = 16;
[[maybe_unused]] constexpr uint64_t kMostUniformBytes = 16384; // what every Vulkan device allows
constexpr vk::Format kTexelFormat = vk::Format::eR32G32B32A32Uint;

vk::BufferUsageFlags usageFlags(BufferUse use) {
    using Usage = vk::BufferUsageFlagBits;
    const vk::BufferUsageFlags copies = Usage::eTransferSrc | Usage::eTransferDst;
    if (use == BufferUse::texels)
        return copies | Usage::eUniformTexelBuffer;
    if (use == BufferUse::uniform)
        return copies | Usage::eUniformBuffer;
    return copies | Usage::eStorageBuffer | Usage::eIndirectBuffer;
}

// Memory types, best first: what the host can map costs no staging copy, and on CPUs and integrated GPUs it
// is the same memory.
std::vector<vk::MemoryPropertyFlags> memoryWishes(BufferUse use) {
    using Memory = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags mappable = Memory::eHostVisible | Memory::eHostCoherent;
    if (use == BufferUse::readback)
        return {mappable | Memory::eHostCached, mappable};
    return {mappable | Memory::eDeviceLocal, Memory::eDeviceLocal, mappable};
}

// Mesa 22.3's lavapipe takes two properties of a texel buffer for parts of a kernel's key that it means for
// pictures: whether the size is a power of two, and whether its second byte is 0. All our buffers answer
// alike, by up to 272 bytes more than asked for: otherwise a kernel is compiled anew for each combination
// that comes along.
uint64_t texelBytes(uint64_t bytes) {
    const uint64_t size = (bytes + kTexelBytes - 1) / kTexelBytes * kTexelBytes;
    const uint64_t withSecondByte = (size & 0xff00u) == 0 ? size + 0x100u : size;
    return std::has_single_bit(withSecondByte) ? withSecondByte + kTexelBytes : withSecondByte;
}

uint64_t allocatedBytes(uint64_t bytes, BufferUse use) {
    return use == BufferUse::texels ? texelBytes(bytes) : std::max(bytes, kTexelBytes);
}

void checkLimits(const Device& device, const std::string& name, uint64_t bytes, BufferUse use) {
    const bool isTexels = use == BufferUse::texels;
    const uint64_t most = isTexels ? device.limits().maxTexelBufferElements * kTexelBytes
                                   : device.limits().maxStorageBufferBytes;
    if (bytes > most)
        throw Error(fmt::format("{} needs {:.1f} MiB, but {} allows {:.1f} MiB in one {} buffer", name,
                                static_cast<double>(bytes) / 1048576.0, device.description().name,
                                static_cast<double>(most) / 1048576.0, isTexels ? "texel" : "storage"));
}

} // namespace

Buffer::Buffer(Device& device, std::string name, uint64_t bytes, BufferUse use)
    : device_(&device), name_(std::move(name)), bytes_(bytes), use_(use) {
    assert(use != BufferUse::uniform || bytes <= kMostUniformBytes);
    checkLimits(device, name_, allocatedBytes(bytes, use), use);
    allocate();
}

void Buffer::allocate() {
    const vk::raii::Device& device = device_->handle();
    const uint64_t size = allocatedBytes(bytes_, use_);
    buffer_ = checked("create", name_, [&] {
        return vk::raii::Buffer(device, vk::BufferCreateInfo({}, size, usageFlags(use_)));
    });
    const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
    uint32_t type = ~0u;
    for (const vk::MemoryPropertyFlags& wish : memoryWishes(use_))
        if (type == ~0u)
            type = device_->findMemoryType(needs.memoryTypeBits, wish);
    if (type == ~0u)
        throw Error(fmt::format("cannot allocate {}: no suitable memory type", name_));
    reservation_ = device_->reserve(needs.size, name_);
    memory_ = checked("allocate", name_, [&] {
        return vk::raii::DeviceMemory(device, vk::MemoryAllocateInfo(needs.size, type));
    });
    checked("bind memory of", name_, [&] { buffer_.bindMemory(*memory_, 0); });
    using Memory = vk::MemoryPropertyFlagBits;
    const uint32_t mappable =
        device_->findMemoryType(1u << type, Memory::eHostVisible | Memory::eHostCoherent);
    if (mappable == type)
        mapped_ = checked("map", name_, [&] { return memory_.mapMemory(0, VK_WHOLE_SIZE); });
    if (use_ == BufferUse::texels)
        view_ = checked("view", name_, [&] {
            return vk::raii::BufferView(device,
                                        vk::BufferViewCreateInfo({}, *buffer_, kTexelFormat, 0, size));
        });
}

void Buffer::upload(std::span<const std::byte> data) {
    assert(data.size() <= bytes_);
    if (data.empty())
        return;
    if (mapped_ != nullptr) {
        std::memcpy(mapped_, data.data(), data.size());
        return;
    }
    Buffer staging(*device_, name_ + " (staging)", data.size(), BufferUse::readback);
    staging.upload(data);
    copyAndWait(*device_, staging, *this, data.size());
}

void Buffer::download(std::span<std::byte> data) const {
    assert(data.size() <= bytes_);
    if (data.empty())
        return;
    if (mapped_ != nullptr) {
        std::memcpy(data.data(), mapped_, data.size());
        return;
    }
    Buffer staging(*device_, name_ + " (staging)", data.size(), BufferUse::readback);
    copyAndWait(*device_, *this, staging, data.size());
    staging.download(data);
}

} // namespace lavalight::gpu
