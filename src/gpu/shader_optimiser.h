// Makes kernels smaller before a driver sees them, by SPIRV-Tools: drivers are slower at it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/shader_build.h"

namespace lavalight::gpu {

// SPIR-V with everything inlined and simplified; specialisation constants stay open. Takes 1.5 s for the
// largest kernel: for the build. lavapipe makes a pipeline of it in a sixth of the time that it takes for
// SPIR-V as the compiler leaves it. Throws Error.
[[nodiscard]] std::vector<uint32_t> optimised(const std::vector<uint32_t>& spirv);

// SPIR-V whose specialisation constants have those values, without the code that they switch off. Takes 0.1 s
// for the largest kernel and halves lavapipe's time: for kernels compiled while somebody waits. Throws Error.
[[nodiscard]] std::vector<uint32_t> specialised(const std::vector<uint32_t>& spirv,
                                                std::span<const SpecialisationConstant> constants);

} // namespace lavalight::gpu
