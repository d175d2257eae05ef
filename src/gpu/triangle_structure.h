// Triangles in an acceleration structure of the device's own (VK_KHR_acceleration_structure), for kernels
// that ask it about rays.
#pragma once

#include <cstdint>
#include <optional>

#include <vulkan/vulkan_raii.hpp>

#include "gpu/buffer.h"
#include "gpu/device.h"

namespace lavalight::gpu {

class TriangleStructure {
  public:
    static constexpr uint64_t kCornerBytes = 16; // from one corner to the next; three floats count
    static constexpr uint64_t kTriangleBytes = 3 * kCornerBytes;

    // Has the device build it, and waits. `corners` is a buffer for BufferUse::corners, and may go
    // afterwards. Kernels are asked about every triangle: none is opaque. Throws Error where the device
    // traces no rays, or not that many triangles.
    TriangleStructure(Device& device, const Buffer& corners, uint64_t triangles);

    [[nodiscard]] vk::AccelerationStructureKHR handle() const { return *top_->handle; }
    [[nodiscard]] uint64_t bytes() const { return bytes_; }
    [[nodiscard]] double buildSeconds() const { return buildSeconds_; }

  private:
    struct Level {
        Buffer memory;
        vk::raii::AccelerationStructureKHR handle = nullptr;
    };
    [[nodiscard]] Level build(vk::AccelerationStructureTypeKHR type,
                              const vk::AccelerationStructureGeometryKHR& geometry, uint32_t primitives);
    [[nodiscard]] Level buildBottom(const Buffer& corners, uint32_t triangles);
    [[nodiscard]] Level buildTop();

    Device* device_;
    std::optional<Level> bottom_; // the triangles; none where there are none
    std::optional<Level> top_;    // one instance of the bottom
    uint64_t bytes_ = 0;
    double buildSeconds_ = 0.0;
};

} // namespace lavalight::gpu
