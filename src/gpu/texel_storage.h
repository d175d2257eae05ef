// Kernels for devices whose texel buffers are too small for scenes: the same fetches, from storage buffers.
#pragma once

#include "gpu/shader_build.h"

namespace lavalight::gpu {

// Makes each `uniform utextureBuffer` of a kernel a `readonly buffer { uvec4 texels[]; }` of the same name
// and binding, and each texelFetch from it an element of that. This changes the SPIR-V and not the source:
// the embedded kernels serve as they are, inlined, without a second set of them in the program or a
// compilation at its start, and so do those of users and tests. Throws Error for a kernel that does anything
// else with a texel buffer.
[[nodiscard]] KernelCode withTexelsInStorage(KernelCode code);

} // namespace lavalight::gpu
