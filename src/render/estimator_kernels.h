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

// Names of the kernels of one way to render, which must not be automatic.
[[nodiscard]] std::vector<std::string_view> estimatorKernelNames(Kernels kernels);

// The kernels of one way to render, specialised, and compiled by the driver. No
// scene need be uploaded yet.
class EstimatorKernels {
  public:
    // `kernels` must not be automatic.
    EstimatorKernels(gpu::Device& device, Kernels kernels, const EstimatorSettings& settings,
                     SceneFeatures features, const KernelSource& source);

    // Names of those whose code `source` changes. Throws Error as `source` does.
    [[nodiscard]] std::vector<std::string> changed(const KernelSource& source) const;
    // Compiles those anew; what was bound to them must be bound anew. Throws
    // Error with every kernel as it was.
    void reload(gpu::Device& device, const KernelSource& source);

    // The kernel must be one of that way.
    [[nodiscard]] const gpu::Kernel& operator[](std::string_view name) const;
    [[nodiscard]] const std::map<std::string, gpu::Kernel, std::less<>>& all() const { return kernels_; }
    // Whether they are what the constructor would make of these.
    [[nodiscard]] bool serve(Kernels kernels, const EstimatorSettings& settings,
                             SceneFeatures features) const;
    // For another render, which they cost no time.
    [[nodiscard]] EstimatorKernels handOn() && {
        seconds_ = 0.0;
        return std::move(*this);
    }
    [[nodiscard]] std::span<const gpu::SpecialisationConstant> constants() const { return constants_; }
    // That all of it took.
    [[nodiscard]] double seconds() const { return seconds_; }

  private:
    Kernels way_;
    std::vector<gpu::SpecialisationConstant> constants_;
    std::map<std::string, gpu::Kernel, std::less<>> kernels_;
    double seconds_ = 0.0;
};

} // namespace lavalight
