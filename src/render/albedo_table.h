// The table behind the coupling of diffuse and specular: directional albedo of the GGX lobe.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"

namespace lavalight {

// Computed on the device by shaders/kernels/albedo.comp, so that it rests on the functions that shading uses.
// Layout: kAlbedoRoughnesses rows of kAlbedoRow texels (shaders/shared/scene.h), the two terms in x and y.
[[nodiscard]] gpu::Buffer makeAlbedoTable(gpu::Device& device);

} // namespace lavalight
