// The table behind the coupling of diffuse and specular: directional albedo of the GGX lobe.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/shader_build.h"

namespace lavalight {

// Layout: kAlbedoRoughnesses rows of kAlbedoRow texels (shaders/shared/scene.h), the two terms in x and y.
struct AlbedoTable {
    gpu::Buffer buffer;
    std::vector<uint32_t>
        spirv; // of the kernel that computed it; empty: no texels, for scenes that ask for none
};

// Computed on the device by the code of shaders/kernels/albedo.comp, so that it rests on the functions that
// shading uses.
[[nodiscard]] AlbedoTable makeAlbedoTable(gpu::Device& device, gpu::KernelCode code);

} // namespace lavalight
