// Makes kernels smaller before a driver sees them, by SPIRV-Tools: drivers are slower at it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/shader_build.h"

namespace lavalight::gpu {

// SPIR-V whose specialisation constants have those values, without the code that they switch off. Takes 0.1 s
// for the largest kernel, and lavapipe then makes its pipeline in a third of the time. Throws Error.
[[nodiscard]] std::vector<uint32_t> specialised(const std::vector<uint32_t>& spirv,
                                                std::span<const SpecialisationConstant> constants);

} // namespace lavalight::gpu
