// Rays of paths traced by the host: the functions of shaders/scene/path_rays.glsl, compiled for the host,
// with a tree of the host's own or Embree in the place of the kernels' accelerator.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <glm/glm.hpp>

#include "accel/bvh16.h"
#include "accel/embree_triangles.h"
#include "device_scene/gpu_scene.h"
#include "gpu/kernel.h"
#include "hosted/bvh16_rays.h"
#include "kernels/kernel_source.h"
#include "shared/features.h"
#include "shared/frame.h"
#include "shared/wavefront.h"

namespace lavalight {

// A scene whose buffers the host reads where the device does: one that shares its memory.
struct HostScene {
    // The buffers that kernels know by these names.
    std::span<const glm::uvec4> triangles, triangleNormals, materials, pictures, textures, triangleUvs,
        triangleColors;
    // Over the records of `triangles`; one of them is null.
    const Bvh16* bvh16;
    const EmbreeTriangles* embree;
    SceneFeatures features; // the camera's too
};

// `scene` must outlive the result, and its accelerator be on the host.
[[nodiscard]] HostScene hostScene(const GpuScene& scene, SceneFeatures features);

// Kernels with the code that the host runs. Schedule::hosted does not run them.
inline constexpr std::array<std::string_view, 3> kTracingKernels{"extend", "connect", "hosted/proposed"};

// Whether kernels by `source` trace rays as the host does: it runs the code that the build embedded. Throws
// Error where one does not compile.
[[nodiscard]] bool tracesAsHost(const KernelSource& source);

struct HostHit {
    Hit hit;           // its surface is its record; where t is infinite, the rest counts for nothing
    uint32_t material; // index of the surface's material
};

// The answer for a ray depends on that ray alone, not on those that are traced with it: our own test
// decides where triangles are met, and at equal t the one of the lowest number is hit, in whatever order
// they are found. For one thread.
class HostRays {
  public:
    HostRays(const HostScene& scene, const FrameParameters& frame, const WaveRange& range);
    ~HostRays();

    // trace() and isOccluded() of shaders/scene/path_rays.glsl for each ray of paths after `bounce` vertices.
    // All spans have one length.
    void trace(uint32_t bounce, Likeness likeness, std::span<const uint32_t> slots, std::span<Ray> rays,
               std::span<HostHit> hits);
    void findOccluded(uint32_t bounce, std::span<const uint32_t> slots, std::span<const ShadowRay> rays,
                      std::span<uint8_t> occluded);

  private:
    struct Members;
    std::unique_ptr<Members> members_;
};

} // namespace lavalight
