// Where compiled kernels come from.
#pragma once

#include <functional>
#include <string_view>

#include "gpu/shader_build.h"

namespace lavalight {

// By name, such as "path". Throws Error for one that there is not, or that does not compile.
using KernelSource = std::function<gpu::KernelCode(std::string_view name)>;

// Those that the build compiled.
[[nodiscard]] gpu::KernelCode embeddedKernel(std::string_view name);

} // namespace lavalight
