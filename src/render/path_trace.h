// One path of a render, vertex by vertex: for looking at, not for images.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/device.h"
#include "render/kernel_source.h"
#include "render/renderer.h"
#include "shared/traced_path.h"

namespace lavalight {

struct TracedPath {
    std::vector<TracedVertex> vertices; // the last one may be where the path left the scene
    glm::vec3 radiance{0.0f};           // that the sample adds to its pixel
};

// The path that sample number `sample` of `pixel` (from the top left) takes with the renderer's scene, camera
// and settings; the kernel trace_path has the estimator's own functions. The pixel must lie in the image.
[[nodiscard]] TracedPath tracePath(gpu::Device& device, const Renderer& renderer, const glm::uvec2& pixel,
                                   uint32_t sample, const KernelSource& source = embeddedKernel);

} // namespace lavalight
