// A scene on the device: BVH, triangles, normals, materials and lights, each uploaded once.
#pragma once

#include <cstdint>

#include "accel/bvh.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "light/lights.h"
#include "scene/scene.h"

namespace lavalight {

// Of the alias table of lights, as FrameParameters has them.
struct LightColumns {
    uint32_t first = 0;
    uint32_t count = 0;
};

class GpuScene {
  public:
    // Builds the BVH and the light table, then uploads. `environment`, `bsdfFindsEnvironment`: as in
    // collectLights(). Throws Error where a limit of the device is exceeded.
    GpuScene(gpu::Device& device, const Scene& scene, const glm::vec3& environment = glm::vec3(0.0f),
             LightSelection selection = LightSelection::power, bool bsdfFindsEnvironment = true);

    // Puts the buffers into `resources` under the names of the kernels.
    void addTo(gpu::ResourceTable& resources) const;

    // As resolved.
    [[nodiscard]] LightSelection lightSelection() const { return lightSelection_; }
    [[nodiscard]] LightColumns lightColumns() const { return lightColumns_; }
    // Number of the environment among the lights, or kNoLight.
    [[nodiscard]] uint32_t environmentLight() const { return environmentLight_; }
    // kFeature... bits: what kernels for this scene need to know of.
    [[nodiscard]] uint32_t features() const { return features_; }
    [[nodiscard]] double bvhSeconds() const { return bvhSeconds_; }
    [[nodiscard]] uint64_t bytes() const;

  private:
    struct Prepared;
    GpuScene(gpu::Device& device, const Prepared& prepared);
    [[nodiscard]] static Prepared prepare(const Scene& scene, const Lights& lights);

    LightSelection lightSelection_;
    LightColumns lightColumns_;
    uint32_t environmentLight_;
    uint32_t features_;
    double bvhSeconds_;
    gpu::Buffer nodes_;
    gpu::Buffer leafTriangles_;
    gpu::Buffer normals_;
    gpu::Buffer materials_;
    gpu::Buffer lights_;
    gpu::Buffer punctuals_;
    gpu::Buffer lightTree_;
    gpu::Buffer albedoTable_;
};

} // namespace lavalight
