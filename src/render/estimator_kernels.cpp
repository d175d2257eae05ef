#include "render/estimator_kernels.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/parallel.h"
#include "device_scene/scene_features.h"
#include "gpu/warm_up.h"
#include "hosted/record_planes.h"
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

std::string variantName(std::string_view kernel, const MaterialClass& materials) {
    return fmt::format("{} of {} materials", kernel, materials.name);
}

namespace {

// The file in a kernel's place where films have layers.
std::string_view ofLayers(std::span<const Phase> phases, std::string_view kernel) {
    for (const Phase& phase : phases)
        if (phase.transport->sink.kernel == kernel)
            return phase.transport->sinkOfLayers;
    return {};
}

} // namespace

std::vector<KernelVariant> kernelVariants(std::span<const Phase> phases, Schedule schedule,
                                          const MaterialClasses& classes, std::string_view accelerator) {
    std::vector<KernelVariant> variants;
    for (const std::string_view kernel : kernelNames(phases, schedule)) {
        const auto scatters = [&](const Phase& phase) { return phase.transport->hosted.scatter == kernel; };
        if (schedule != Schedule::hosted || std::none_of(phases.begin(), phases.end(), scatters))
            variants.push_back({std::string(kernel), kernel, 0, ofLayers(phases, kernel), accelerator});
        else
            for (const MaterialClass& materials : classes.list)
                variants.push_back({variantName(kernel, materials), kernel, materials.without});
    }
    return variants;
}

EstimatorKernels::EstimatorKernels(gpu::Device& device, std::vector<KernelVariant> variants,
                                   const EstimatorSettings& settings, SceneFeatures features, uint32_t planes,
                                   const KernelSource& source)
    : settings_(settings), features_(features), planes_(planes),
      constants_(estimatorConstants(settings, features)), variants_(std::move(variants)) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<const KernelVariant*> all;
    for (const KernelVariant& variant : variants_)
        all.push_back(&variant);
    kernels_ = compile(device, all, source);
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string_view EstimatorKernels::fileOf(const KernelVariant& variant) const {
    constexpr uint32_t kWithoutLayers = 1u << kColorPlane | 1u << kCoveragePlane | kNegativeWeights;
    const bool hasLayers = (planes_ & ~kWithoutLayers) != 0;
    return hasLayers && !variant.ofLayers.empty() ? variant.ofLayers : variant.kernel;
}

std::string EstimatorKernels::sourceName(const KernelVariant& variant) const {
    return textOf({fileOf(variant), variant.accelerator});
}

std::vector<gpu::SpecialisationConstant> EstimatorKernels::constantsOf(const KernelVariant& variant) const {
    // Records are laid out by the features of the whole scene.
    std::vector<gpu::SpecialisationConstant> constants =
        estimatorConstants(settings_, features_ & ~variant.without);
    constants.push_back({CONSTANT_RECORD_PLANES, recordPlanes(features_)});
    constants.push_back({CONSTANT_FILM_PLANES, planes_});
    return constants;
}

KernelMap EstimatorKernels::compile(gpu::Device& device, std::span<const KernelVariant* const> variants,
                                    const KernelSource& source) const {
    std::vector<gpu::KernelCode> codes; // in order, so that of several with errors the same one throws
    for (const KernelVariant* variant : variants)
        codes.push_back(source(sourceName(*variant)));
    std::vector<std::optional<gpu::Kernel>> built(variants.size());
    forEachInParallel(variants.size(), [&](size_t i) {
        built[i].emplace(device, std::move(codes[i]), constantsOf(*variants[i]));
    });
    KernelMap kernels;
    std::vector<const gpu::Kernel*> made;
    for (size_t i = 0; i < variants.size(); ++i)
        made.push_back(&kernels.try_emplace(variants[i]->name, std::move(*built[i])).first->second);
    if (!made.empty())
        gpu::warmUp(device, made);
    return kernels;
}

std::vector<std::string> EstimatorKernels::changed(const KernelSource& source) const {
    std::vector<std::string> names;
    for (const KernelVariant& variant : variants_)
        if (isChanged(variant, source) &&
            std::find(names.begin(), names.end(), fileOf(variant)) == names.end())
            names.emplace_back(fileOf(variant));
    return names;
}

bool EstimatorKernels::isChanged(const KernelVariant& variant, const KernelSource& source) const {
    return source(sourceName(variant)).content != (*this)[variant.name].code().content;
}

KernelMap EstimatorKernels::compileChanged(gpu::Device& device, const KernelSource& source) const {
    std::vector<const KernelVariant*> stale;
    for (const KernelVariant& variant : variants_)
        if (isChanged(variant, source))
            stale.push_back(&variant);
    return compile(device, stale, source);
}

void EstimatorKernels::replace(KernelMap compiled) noexcept {
    for (const auto& [name, kernel] : compiled)
        kernels_.erase(name);
    kernels_.merge(compiled); // kernels stay at their addresses, which bound ones know
}

bool EstimatorKernels::serve(std::span<const KernelVariant> variants, const EstimatorSettings& settings,
                             SceneFeatures features, uint32_t planes) const {
    return std::ranges::equal(variants, variants_) && features == features_ && planes == planes_ &&
           estimatorConstants(settings, features) == constants_;
}

const gpu::Kernel& EstimatorKernels::operator[](std::string_view name) const {
    const auto found = kernels_.find(name);
    assert(found != kernels_.end());
    return found->second;
}

} // namespace lavalight
