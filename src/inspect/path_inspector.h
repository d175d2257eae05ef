// One path of a render, vertex by vertex: for looking at, not for images.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/device.h"
#include "gpu/kernel.h"
#include "kernels/kernel_source.h"
#include "render/renderer.h"
#include "shared/traced_path.h"

namespace lavalight {

struct TracedPath {
    std::vector<TracedVertex> vertices; // the last one may be where the path left the scene
    glm::vec3 radiance{0.0f};           // what the sample adds to its pixel
};

// Follows paths with a kernel that has the estimator's own functions and is compiled once: trace_path, or
// hosted/trace_path for renders whose rays the host traces.
class PathInspector {
  public:
    // For renders with the renderer's estimator, features and accelerator. The device must outlive it. Throws
    // Error.
    PathInspector(gpu::Device& device, const Renderer& renderer, const KernelSource& source = embeddedKernel);

    // Whether this one's kernel is that of the renderer's estimator, features and accelerator.
    [[nodiscard]] bool serves(const Renderer& renderer) const;

    // The path that sample number `sample` of `pixel` (from the top left) takes with the renderer's scene,
    // camera and settings. The pixel must lie in the image, and the renderer be one that this serves.
    [[nodiscard]] TracedPath trace(const Renderer& renderer, const glm::uvec2& pixel, uint32_t sample) const;

  private:
    class State;
    [[nodiscard]] TracedVertex traceByHost(const Renderer& renderer, State& state, WaveRange range) const;

    gpu::Device* device_;
    std::vector<gpu::SpecialisationConstant> constants_;
    AcceleratorKind accelerator_;
    gpu::Kernel kernel_;
};

} // namespace lavalight
