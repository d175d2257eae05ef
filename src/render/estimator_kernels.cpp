#include "render/estimator_kernels.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "device_scene/scene_features.h"
#include "gpu/warm_up.h"
#include "render/setting_table.h"

namespace lavalight {

std::vector<gpu::SpecialisationConstant> estimatorConstants(const EstimatorSettings& settings,
                                                            SceneFeatures features) {
    const auto [first, second] = featureConstants(features);
    std::vector<gpu::SpecialisationConstant> constants{first, second};
    for (const SettingRow& row : settingRows())
        if (const auto* values = std::get_if<NamedValues>(&row.values); values && values->constant)
            constants.push_back({*values->constant, values->get(settings)});
    return constants;
}

EstimatorKernels::EstimatorKernels(gpu::Device& device, std::span<const std::string_view> names,
                                   const EstimatorSettings& settings, SceneFeatures features,
                                   const KernelSource& source)
    : constants_(estimatorConstants(settings, features)) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<const gpu::Kernel*> made;
    for (const std::string_view name : names)
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

bool EstimatorKernels::serve(std::span<const std::string_view> names, const EstimatorSettings& settings,
                             SceneFeatures features) const {
    const bool hasAll = names.size() == kernels_.size() &&
                        std::all_of(names.begin(), names.end(),
                                    [&](std::string_view name) { return kernels_.contains(name); });
    return hasAll && estimatorConstants(settings, features) == constants_;
}

const gpu::Kernel& EstimatorKernels::operator[](std::string_view name) const {
    const auto found = kernels_.find(name);
    assert(found != kernels_.end());
    return found->second;
}

} // namespace lavalight
