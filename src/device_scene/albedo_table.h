// The table behind the coupling of diffuse and specular: directional albedos of the GGX lobe and of sheen.
#pragma once

#include <cstdint>
#include <string>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/shader_build.h"

namespace lavalight {

// The layout is in shaders/shared/scene.h; what an entry holds, in shaders/scene/albedo_table.glsl.
struct AlbedoTable {
    gpu::Buffer buffer;
    // Hash of the kernel that computed the table; empty: no texels, for scenes that ask for none.
    std::string kernelContent;
};

// Computes the table on the device by the code of shaders/kernels/albedo.comp, so that it rests on the
// functions that shading uses.
[[nodiscard]] AlbedoTable makeAlbedoTable(gpu::Device& device, gpu::KernelCode code);

} // namespace lavalight
