// What SPIRV-Tools does to kernels before a driver sees them: drivers are slower at it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lavalight::gpu {

// The value of a constant that a shader declares as layout(constant_id = id) const uint/int/bool/float;
// floats as their bits.
struct SpecialisationConstant {
    uint32_t id = 0;
    uint32_t value = 0;
    bool operator==(const SpecialisationConstant&) const = default;
};

// A kernel with its functions inlined, but for those that return early, and without the loads, the stores and
// the branches on constant arguments that this makes needless. Takes a second for the largest kernel, so it
// is for the build; lavapipe then goes through the code in two fifths to two thirds of the time, and what it
// makes of it renders as fast. More passes would cost: functions brought to a single return, or values in SSA
// form, render slower by a tenth (docs/performance.md). Throws Error.
[[nodiscard]] std::vector<uint32_t> inlined(const std::vector<uint32_t>& spirv);

// SPIR-V whose specialisation constants have those values, without the code that they switch off. Takes 0.1 s
// for the largest kernel; before kernels were inlined, lavapipe then made its pipeline in a third of the
// time. Throws Error.
[[nodiscard]] std::vector<uint32_t> specialised(const std::vector<uint32_t>& spirv,
                                                std::span<const SpecialisationConstant> constants);

// The constants that the module declares, in the order given.
[[nodiscard]] std::vector<SpecialisationConstant>
declaredIn(std::span<const uint32_t> spirv, std::span<const SpecialisationConstant> constants);

// Names specialised()'s passes and the version of SPIRV-Tools: what its result depends on beside its
// arguments.
[[nodiscard]] std::string specialisingPasses();

} // namespace lavalight::gpu
