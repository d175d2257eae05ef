// Kernels of the estimator: where their code comes from, and the constants that specialise them.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "gpu/kernel.h"
#include "render/settings.h"

namespace lavalight {

// Where compiled kernels come from, by name.
using KernelSource = std::function<gpu::KernelCode(std::string_view name)>;

// Those that the build compiled.
[[nodiscard]] gpu::KernelCode embeddedKernel(std::string_view name);

// For lib/estimator.glsl and lib/features.glsl; `features`: of the scene, kFeature... bits. Kernels ignore
// constants that they do not declare.
[[nodiscard]] std::vector<gpu::SpecialisationConstant> estimatorConstants(const EstimatorSettings& settings,
                                                                          uint32_t features);

} // namespace lavalight
