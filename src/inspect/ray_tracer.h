// Traces given rays through a scene as renders do, by its accelerator: for benchmarks and tests of traversal.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "device_scene/gpu_scene.h"
#include "gpu/commands.h"
#include "gpu/device.h"
#include "gpu/kernel.h"
#include "hosted/bvh16_rays.h"
#include "shared/trace.h"
#include "shared/wavefront.h"

namespace lavalight {

class RayTracer {
  public:
    // Builds the kernels, if it is they that trace; they are slower if they are to count. The device and the
    // scene must outlive the tracer.
    RayTracer(gpu::Device& device, const GpuScene& scene, bool countsVisits = false);

    // The most rays of one call: what a dispatch and a storage buffer of the device hold.
    [[nodiscard]] size_t maxRays() const;

    // The first hit with t > 0 of each ray, from either side, but not of the triangle that it starts on.
    // Kernels ignore the likeness.
    [[nodiscard]] std::vector<TracedHit> closest(std::span<const Ray> rays,
                                                 Likeness likeness = Likeness::unlike);
    // A flag for each ray: 1 where anything but the triangles that the ray starts and ends on lies at
    // 0 < t < 1. Contributions are ignored.
    [[nodiscard]] std::vector<uint32_t> occluded(std::span<const ShadowRay> rays);

    // Device time of the last call's kernel, 0 on a queue without timestamps; or the host's time.
    [[nodiscard]] double lastSeconds() const { return lastSeconds_; }
    // What the rays of the last call visited altogether, modulo 2^32; nothing unless kernels count.
    [[nodiscard]] const VisitCounts& lastVisits() const { return lastVisits_; }

  private:
    // Has the host take parts of `count` rays: take(host, first, end), on all processors.
    template <typename Take>
    void byHost(size_t count, const Take& take);
    void run(const gpu::Kernel& kernel, gpu::ResourceTable resources, size_t rays);

    gpu::Device* device_;
    const GpuScene* scene_;
    std::optional<gpu::Kernel> closest_; // none: the host traces
    std::optional<gpu::Kernel> any_;
    gpu::Buffer visits_;
    VisitCounts lastVisits_{};
    double lastSeconds_ = 0.0;
};

} // namespace lavalight
