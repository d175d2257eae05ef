#include "render/estimator_kernels.h"

#include "kernels.h"

namespace lavalight {

gpu::KernelCode embeddedKernel(std::string_view name) {
    return kernels::find(name);
}

std::vector<gpu::SpecialisationConstant> estimatorConstants(const EstimatorSettings& settings,
                                                            uint32_t features) {
    return {{CONSTANT_SAMPLER, static_cast<uint32_t>(settings.sampler)},
            {CONSTANT_HEMISPHERE, static_cast<uint32_t>(settings.hemisphere)},
            {CONSTANT_NEE, settings.nextEventEstimation ? 1u : 0u},
            {CONSTANT_MIS, static_cast<uint32_t>(settings.mis)},
            {CONSTANT_ROULETTE, static_cast<uint32_t>(settings.roulette)},
            {CONSTANT_MIS_SURVIVAL, settings.misSurvival ? 1u : 0u},
            {CONSTANT_FRESNEL, static_cast<uint32_t>(settings.fresnel)},
            {CONSTANT_FEATURES, features}};
}

} // namespace lavalight
