// Where compiled kernels come from.
#pragma once

#include <functional>
#include <string_view>

#include "gpu/shader_build.h"

namespace lavalight {

// The kernel of a name, which is its path below shaders/kernels/ without the extension: "path", "lab/dice";
// with another accelerator than bvh8 "path@ray_query" (kernels/accelerator_name.h). Throws Error for one that
// there is not, or that does not compile.
using KernelSource = std::function<gpu::KernelCode(std::string_view name)>;

// The kernels that the build compiled.
[[nodiscard]] gpu::KernelCode embeddedKernel(std::string_view name);

} // namespace lavalight
