#include "render/estimator_kernels.h"

#include <cassert>
#include <chrono>

#include "device_scene/scene_features.h"
#include "gpu/warm_up.h"

namespace lavalight {

std::vector<gpu::SpecialisationConstant> estimatorConstants(const EstimatorSettings& settings,
                                                            SceneFeatures features) {
    const auto [first, second] = featureConstants(features);
    return {{CONSTANT_SAMPLER, static_cast<uint32_t>(settings.sampler)},
            {CONSTANT_HEMISPHERE, static_cast<uint32_t>(settings.hemisphere)},
            {CONSTANT_NEE, settings.nextEventEstimation ? 1u : 0u},
            {CONSTANT_MIS, static_cast<uint32_t>(settings.mis)},
            {CONSTANT_ROULETTE, static_cast<uint32_t>(settings.roulette)},
            {CONSTANT_MIS_SURVIVAL, settings.misSurvival ? 1u : 0u},
            {CONSTANT_FRESNEL, static_cast<uint32_t>(settings.fresnel)},
            {CONSTANT_MULTIPLE_SCATTERING, settings.multipleScattering ? 1u : 0u},
            {CONSTANT_TEXTURE_FILTER, static_cast<uint32_t>(settings.textureFilter)},
            first,
            second};
}

std::vector<std::string_view> estimatorKernelNames(Schedule schedule) {
    assert(schedule != Schedule::automatic);
    if (schedule == Schedule::fused)
        return {"path", "accumulate"};
    return {"generate", "extend", "shade", "prepare", "connect", "accumulate"};
}

EstimatorKernels::EstimatorKernels(gpu::Device& device, Schedule schedule, const EstimatorSettings& settings,
                                   SceneFeatures features, const KernelSource& source)
    : schedule_(schedule), constants_(estimatorConstants(settings, features)) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<const gpu::Kernel*> made;
    for (const std::string_view name : estimatorKernelNames(schedule))
        made.push_back(
            &kernels_.try_emplace(std::string(name), device, source(name), constants_).first->second);
    gpu::warmUp(device, made);
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<std::string> EstimatorKernels::changed(const KernelSource& source) const {
    std::vector<std::string> names;
    for (const auto& [name, kernel] : kernels_)
        if (source(name).content != kernel.code().content)
            names.push_back(name);
    return names;
}

KernelMap EstimatorKernels::compileChanged(gpu::Device& device, const KernelSource& source) const {
    KernelMap fresh;
    std::vector<const gpu::Kernel*> made;
    for (const std::string& name : changed(source))
        made.push_back(&fresh.try_emplace(name, device, source(name), constants_).first->second);
    if (!made.empty())
        gpu::warmUp(device, made);
    return fresh;
}

void EstimatorKernels::replace(KernelMap compiled) noexcept {
    for (const auto& [name, kernel] : compiled)
        kernels_.erase(name);
    kernels_.merge(compiled); // kernels stay at their addresses, which bound ones know
}

bool EstimatorKernels::serve(Schedule schedule, const EstimatorSettings& settings,
                             SceneFeatures features) const {
    return schedule == schedule_ && estimatorConstants(settings, features) == constants_;
}

const gpu::Kernel& EstimatorKernels::operator[](std::string_view name) const {
    const auto found = kernels_.find(name);
    assert(found != kernels_.end());
    return found->second;
}

} // namespace lavalight
