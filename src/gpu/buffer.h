// Device memory as buffers: storage buffers that kernels write, texel buffers that they only read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "gpu/device.h"
#include "gpu/memory_plan.h"

namespace lavalight::gpu {

// One Vulkan buffer with its memory. Contents are undefined until written. Moves, never copies.
class Buffer {
  public:
    // `bytes` may be 0 (a kernel then binds an element that it never reads). Throws Error where a limit of
    // the device or its memory is exceeded, with the figures.
    Buffer(Device& device, std::string name, uint64_t bytes, BufferUse use);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] uint64_t bytes() const { return bytes_; }
    [[nodiscard]] BufferUse use() const { return use_; }

    // Copy from host to device and back, and wait for it; through a staging buffer where the memory cannot be
    // mapped, or is slow to read. No submission that uses the buffer may be running. `data` must not exceed
    // the buffer.
    void upload(std::span<const std::byte> data);
    void download(std::span<std::byte> data) const;

    template <typename T>
    void upload(std::span<const T> data) {
        static_assert(std::is_trivially_copyable_v<T>);
        upload(std::as_bytes(data));
    }
    template <typename T>
    [[nodiscard]] std::vector<T> downloadAll() const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(bytes_ / sizeof(T));
        download(std::as_writable_bytes(std::span(values)));
        return values;
    }

    // The memory itself, where the host reads and writes it as fast as its own: on a CPU. Else empty. What
    // the host writes, kernels of later submissions see; no submission that uses the buffer may be running.
    template <typename T>
    [[nodiscard]] std::span<T> mapped() const {
        static_assert(std::is_trivially_copyable_v<T>);
        return {static_cast<T*>(hostMemory()), hostMemory() == nullptr ? 0 : bytes_ / sizeof(T)};
    }

    [[nodiscard]] vk::Buffer handle() const { return *buffer_; }
    // For BufferUse::corners and structure, on a device that traces rays.
    [[nodiscard]] vk::DeviceAddress address() const;
    // Null on a device that stores texels in storage buffers.
    [[nodiscard]] vk::BufferView texelView() const { return *view_; }

  private:
    void create();
    void allocate();
    [[nodiscard]] void* hostMemory() const { return plan_.isReadMapped ? mapped_ : nullptr; }

    Device* device_; // outlives every buffer
    std::string name_;
    uint64_t bytes_;
    BufferUse use_;
    MemoryReservation reservation_;
    vk::raii::Buffer buffer_ = nullptr;
    vk::raii::DeviceMemory memory_ = nullptr;
    vk::raii::BufferView view_ = nullptr;
    MemoryPlan plan_;
    void* mapped_ = nullptr; // null: as planned
};

} // namespace lavalight::gpu
