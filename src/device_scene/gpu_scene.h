// A scene on the device: accelerator, attributes of triangles, materials,
// textures and lights, each uploaded once.
#pragma once

#include <cstdint>
#include <utility>

#include "device_scene/accelerator.h"
#include "device_scene/albedo_table.h"
#include "device_scene/fingerprint.h"
#include "device_scene/scene_data.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "kernels/kernel_source.h"

namespace lavalight {

class GpuScene {
  public:
    // Uploads. Throws Error where a limit of the device is exceeded.
    GpuScene(gpu::Device& device, const SceneData& data, const KernelSource& source = embeddedKernel);

    // Puts the buffers into `resources` under the names of the kernels.
    void addTo(gpu::ResourceTable& resources) const;

    [[nodiscard]] const AlbedoTable& albedoTable() const { return albedoTable_; }
    // Kernels that were bound to the old one must be bound anew.
    void setAlbedoTable(AlbedoTable table) { albedoTable_ = std::move(table); }

    // What it has: kFeature...
    [[nodiscard]] SceneFeatures features() const { return features_; }
    // Fingerprints of what was uploaded.
    [[nodiscard]] const Fingerprints& fingerprints() const { return fingerprints_; }
    [[nodiscard]] const Accelerator& accelerator() const { return accelerator_; }
    [[nodiscard]] uint64_t bytes() const;

  private:
    SceneFeatures features_;
    Fingerprints fingerprints_;
    Accelerator accelerator_;
    gpu::Buffer normals_;
    gpu::Buffer materials_;
    gpu::Buffer solids_;
    gpu::Buffer lights_;
    gpu::Buffer punctuals_;
    gpu::Buffer lightTree_;
    gpu::Buffer pictures_;
    gpu::Buffer textures_;
    gpu::Buffer uvs_;
    gpu::Buffer colors_;
    gpu::Buffer tangents_;
    gpu::Buffer environmentMap_;
    gpu::Buffer environmentQuads_;
    AlbedoTable albedoTable_;
};

} // namespace lavalight
