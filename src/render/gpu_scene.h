// A scene on the device: BVH, triangles, normals, materials and lights, each uploaded once.
#pragma once

#include <cstdint>

#include "accel/bvh.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "scene/scene.h"

namespace lavalight {

class GpuScene {
  public:
    // Builds the BVH and the light table, then uploads. Throws Error where a limit of the device is exceeded.
    GpuScene(gpu::Device& device, const Scene& scene);

    // Puts the buffers into `resources` under the names of the kernels.
    void addTo(gpu::ResourceTable& resources) const;

    [[nodiscard]] uint32_t emitterCount() const { return emitterCount_; }
    [[nodiscard]] double bvhSeconds() const { return bvhSeconds_; }
    [[nodiscard]] uint64_t bytes() const;

  private:
    struct Prepared;
    GpuScene(gpu::Device& device, const Prepared& prepared);
    [[nodiscard]] static Prepared prepare(const Scene& scene);

    uint32_t emitterCount_;
    double bvhSeconds_;
    gpu::Buffer nodes_;
    gpu::Buffer leafTriangles_;
    gpu::Buffer normals_;
    gpu::Buffer materials_;
    gpu::Buffer emitters_;
    gpu::Buffer albedoTable_;
};

} // namespace lavalight
