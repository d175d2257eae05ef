// The accelerator of a scene, which answers the two functions of shaders/scene/intersect.glsl: the only place
// on the host that knows what it is. Kernels have a BVH or the device's own structure, whose other halves are
// folders of shaders/scene/; the host (src/hosted) has a BVH of its own or Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "accel/bvh.h"
#include "accel/bvh16.h"
#include "accel/embree_triangles.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "gpu/triangle_structure.h"
#include "kernels/accelerator_name.h"
#include "shared/triangle.h"

namespace lavalight {

enum class AcceleratorKind {
    bvh8,    // traversed by kernels
    bvh16,   // traversed by the host
    embree,  // the same
    rayQuery // built by the device, and traversed where kernels ask it (VK_KHR_ray_query)
};

[[nodiscard]] constexpr bool isOnHost(AcceleratorKind kind) {
    return kind == AcceleratorKind::bvh16 || kind == AcceleratorKind::embree;
}

// The name that its kernels have (kernels/accelerator_name.h). Kernels trace nothing where the host does.
[[nodiscard]] std::string_view kernelAccelerator(AcceleratorKind kind);

// An accelerator before it is uploaded. Which builder made the tree decides no bit of a film.
struct AcceleratorData {
    AcceleratorKind kind = AcceleratorKind::bvh8;
    Bvh bvh{};                                       // of AcceleratorKind::bvh8
    std::shared_ptr<const Bvh16> bvh16{};            // of AcceleratorKind::bvh16
    std::shared_ptr<const EmbreeTriangles> embree{}; // of AcceleratorKind::embree

    // Triangle of each record, in the order in which kernels number records; triangles may repeat. But for
    // the BVH, records are the triangles.
    [[nodiscard]] std::vector<uint32_t> trianglesOfRecords(size_t triangles) const;
    // A record of each triangle.
    [[nodiscard]] std::vector<uint32_t> recordsOfTriangles(size_t triangles) const;
    // The name that a film's identity records: Embree's has what it rounds by.
    [[nodiscard]] std::string name() const;
};

// No device is needed. `materials` has the material word of each triangle (shared/scene.h). Throws Error
// where the triangles do not fit.
[[nodiscard]] AcceleratorData buildAccelerator(std::span<const Triangle> triangles,
                                               std::span<const uint32_t> materials, AcceleratorKind kind);

class Accelerator {
  public:
    // Uploads. `triangles` are those that `data` was built of, in the scene's numbering. Throws Error where a
    // limit of the device is exceeded.
    Accelerator(gpu::Device& device, const AcceleratorData& data, std::span<const TriangleRecord> triangles);

    // Puts the buffers into `resources` under the names of the kernels.
    void addTo(gpu::ResourceTable& resources) const;

    [[nodiscard]] AcceleratorKind kind() const { return kind_; }
    // Each is null but for its own kind.
    [[nodiscard]] const Bvh16* bvh16() const { return bvh16_.get(); }
    [[nodiscard]] const EmbreeTriangles* embree() const { return embree_.get(); }
    [[nodiscard]] double buildSeconds() const;
    // On the device, and on the host if it is the host that traces.
    [[nodiscard]] uint64_t bytes() const;

  private:
    AcceleratorKind kind_;
    double bvhSeconds_;
    std::shared_ptr<const Bvh16> bvh16_;
    std::shared_ptr<const EmbreeTriangles> embree_;
    gpu::Buffer nodes_;
    gpu::Buffer triangles_;
    std::optional<gpu::TriangleStructure> structure_; // of AcceleratorKind::rayQuery, over triangles_
    gpu::Buffer extent_;                              // the largest coordinate, for the same
};

} // namespace lavalight
