// Constants of kernels, settled by SPIRV-Tools before a driver sees them: drivers are slower at it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lavalight::gpu {

// layout(constant_id = id) const uint/int/bool/float in the shader; floats as their bits.
struct SpecialisationConstant {
    uint32_t id = 0;
    uint32_t value = 0;
    bool operator==(const SpecialisationConstant&) const = default;
};

// SPIR-V whose specialisation constants have those values, without the code that they switch off. Takes 0.1 s
// for the largest kernel, and lavapipe then makes its pipeline in a third of the time. Throws Error.
[[nodiscard]] std::vector<uint32_t> specialised(const std::vector<uint32_t>& spirv,
                                                std::span<const SpecialisationConstant> constants);

} // namespace lavalight::gpu
