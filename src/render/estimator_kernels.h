// Kernels of the estimator, and the constants that specialise them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/kernel.h"
#include "kernels/kernel_source.h"
#include "render/settings.h"
#include "shared/features.h"

namespace lavalight {

// For lib/estimator.glsl and lib/features.glsl; `features`: of the scene,
// kFeature... bits. Kernels ignore constants that they do not declare.
[[nodiscard]] std::vector<gpu::SpecialisationConstant> estimatorConstants(const EstimatorSettings& settings,
                                                                          SceneFeatures features);

using KernelMap = std::map<std::string, gpu::Kernel, std::less<>>;

// Kernels of a render, specialised, and compiled by the driver. No scene need be uploaded yet.
class EstimatorKernels {
  public:
    // `names`: kernelNames() of the render's phases.
    EstimatorKernels(gpu::Device& device, std::span<const std::string_view> names,
                     const EstimatorSettings& settings, SceneFeatures features, const KernelSource& source);

    // Names of the kernels whose code `source` changes. Throws Error as `source` does.
    [[nodiscard]] std::vector<std::string> changed(const KernelSource& source) const;
    // Compiles them, beside the ones that are in use. Throws Error.
    [[nodiscard]] KernelMap compileChanged(gpu::Device& device, const KernelSource& source) const;
    // Puts compiled kernels in the places of those of their names, which nothing may be bound to any more.
    void replace(KernelMap compiled) noexcept;

    // The kernel must be one of those of the constructor.
    [[nodiscard]] const gpu::Kernel& operator[](std::string_view name) const;
    [[nodiscard]] const KernelMap& all() const { return kernels_; }
    // Whether they are what the constructor would make of these.
    [[nodiscard]] bool serve(std::span<const std::string_view> names, const EstimatorSettings& settings,
                             SceneFeatures features) const;
    // For another render, which they cost no time.
    [[nodiscard]] EstimatorKernels handOn() && {
        seconds_ = 0.0;
        return std::move(*this);
    }
    [[nodiscard]] std::span<const gpu::SpecialisationConstant> constants() const { return constants_; }
    // Seconds spent compiling these kernels.
    [[nodiscard]] double seconds() const { return seconds_; }

  private:
    std::vector<gpu::SpecialisationConstant> constants_;
    KernelMap kernels_;
    double seconds_ = 0.0;
};

} // namespace lavalight
