// The accelerator of a scene, which answers the two functions of shaders/scene/intersect.glsl: the only place
// on the host that knows it is a BVH. Its folder of shaders/scene/ is its other half.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "accel/bvh.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "kernels/accelerator_name.h"
#include "shared/triangle.h"

namespace lavalight {

// An accelerator before it is uploaded. Which builder made the tree decides no bit of a film.
struct AcceleratorData {
    Bvh bvh;

    // Triangle of each record, in the order in which kernels number records; triangles may repeat.
    [[nodiscard]] std::span<const uint32_t> trianglesOfRecords() const { return bvh.leafTriangles; }
    // A record of each triangle.
    [[nodiscard]] std::vector<uint32_t> recordsOfTriangles(size_t triangles) const;
};

// No device is needed. Throws Error where the triangles do not fit.
[[nodiscard]] AcceleratorData buildAccelerator(std::span<const Triangle> triangles);

class Accelerator {
  public:
    // Uploads. `triangles` are those that `data` was built of, in the scene's numbering. Throws Error where a
    // limit of the device is exceeded.
    Accelerator(gpu::Device& device, const AcceleratorData& data, std::span<const TriangleRecord> triangles);

    // Puts the buffers into `resources` under the names of the kernels.
    void addTo(gpu::ResourceTable& resources) const;

    // What a film's identity says of it.
    [[nodiscard]] static std::string_view name() { return kAcceleratorName; }
    [[nodiscard]] double buildSeconds() const { return buildSeconds_; }
    [[nodiscard]] uint64_t bytes() const { return nodes_.bytes() + triangles_.bytes(); }

  private:
    double buildSeconds_;
    gpu::Buffer nodes_;
    gpu::Buffer triangles_;
};

} // namespace lavalight
