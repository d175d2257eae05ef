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

using Usage = vk::BufferUsageFlagBits;

bool holdsTexels(BufferUse use) {
    return use == BufferUse::texels || use == BufferUse::corners;
}

// Buffers that the device finds by their address where it builds an acceleration structure.
vk::BufferUsageFlags buildUsage(BufferUse use) {
    constexpr vk::BufferUsageFlags kInput =
        Usage::eShaderDeviceAddress | Usage::eAccelerationStructureBuildInputReadOnlyKHR;
    return use == BufferUse::structure ? kInput | Usage::eAccelerationStructureStorageKHR
           : use == BufferUse::corners ? kInput
                                       : vk::BufferUsageFlags();
}

vk::BufferUsageFlags usageFlags(BufferUse use, const Device& device) {
    const vk::BufferUsageFlags always = Usage::eTransferSrc | Usage::eTransferDst |
                                        (device.tracesRays() ? buildUsage(use) : vk::BufferUsageFlags());
    if (holdsTexels(use) && !device.storesTexels())
        return always | Usage::eUniformTexelBuffer;
    if (use == BufferUse::uniform)
        return always | Usage::eUniformBuffer;
    return always | Usage::eStorageBuffer | Usage::eIndirectBuffer;
}

bool hasAddress(BufferUse use, const Device& device) {
    return device.tracesRays() && buildUsage(use);
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
    return holdsTexels(use) ? texelBytes(bytes) : std::max(bytes, kTexelBytes);
}

void checkLimits(const Device& device, const std::string& name, uint64_t bytes, BufferUse use) {
    if (use == BufferUse::structure) // no kernel binds it
        return;
    const bool isTexels = holdsTexels(use) && !device.storesTexels();
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
    create();
    allocate();
}

void Buffer::create() {
    const vk::BufferCreateInfo info({}, allocatedBytes(bytes_, use_), usageFlags(use_, *device_));
    buffer_ = checked("create", name_, [&] { return vk::raii::Buffer(device_->handle(), info); });
}

// The driver may refuse memory that seems to be there, such as what other programs use.
void Buffer::allocate() {
    const vk::raii::Device& device = device_->handle();
    const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
    const std::vector<MemoryPlan> plans = device_->planMemory(needs, use_);
    if (plans.empty())
        throw Error(fmt::format("cannot allocate {}: no suitable memory type", name_));
    for (const MemoryPlan& plan : plans) {
        plan_ = plan;
        reservation_ = device_->reserve(needs.size, plan.heap, name_);
        try {
            const vk::MemoryAllocateFlagsInfo withAddress(vk::MemoryAllocateFlagBits::eDeviceAddress);
            const void* next = hasAddress(use_, *device_) ? &withAddress : nullptr;
            memory_ = vk::raii::DeviceMemory(device, vk::MemoryAllocateInfo(needs.size, plan.type, next));
            break;
        } catch (const vk::SystemError& error) {
            if (error.code() != vk::Result::eErrorOutOfDeviceMemory || plan == plans.back())
                throwVulkanError("allocate", name_, error);
        }
    }
    checked("bind memory of", name_, [&] { buffer_.bindMemory(*memory_, 0); });
    if (plan_.isMapped)
        mapped_ = checked("map", name_, [&] { return memory_.mapMemory(0, VK_WHOLE_SIZE); });
    if (holdsTexels(use_) && !device_->storesTexels()) {
        const vk::BufferViewCreateInfo info({}, *buffer_, kTexelFormat, 0, allocatedBytes(bytes_, use_));
        view_ = checked("view", name_, [&] { return vk::raii::BufferView(device, info); });
    }
}

vk::DeviceAddress Buffer::address() const {
    assert(hasAddress(use_, *device_));
    return device_->handle().getBufferAddress(vk::BufferDeviceAddressInfo(*buffer_));
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
    if (plan_.isReadMapped) {
        std::memcpy(data.data(), mapped_, data.size());
        return;
    }
    Buffer staging(*device_, name_ + " (staging)", data.size(), BufferUse::readback);
    copyAndWait(*device_, *this, staging, data.size());
    staging.download(data);
}

} // namespace lavalight::gpu
