// Kernels of the estimator, and the constants that specialise them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device_scene/material_classes.h"
#include "gpu/kernel.h"
#include "kernels/accelerator_name.h"
#include "kernels/kernel_source.h"
#include "render/phase.h"
#include "render/settings.h"
#include "shared/features.h"

namespace lavalight {

// For lib/estimator.glsl and lib/features.glsl; `features`: of the scene,
// kFeature... bits. Kernels ignore constants that they do not declare.
[[nodiscard]] std::vector<gpu::SpecialisationConstant> estimatorConstants(const EstimatorSettings& settings,
                                                                          SceneFeatures features);

// A kernel, or what a class of materials leaves of it.
struct KernelVariant {
    std::string name;            // unlike those of other variants
    std::string_view kernel;     // its file in shaders/kernels, without .comp; lasts as long as the program
    SceneFeatures without = 0;   // features of the scene that it does not need
    std::string_view ofLayers{}; // the file in its place where films have layers; empty: the same
    std::string_view accelerator = kBvh8; // with which it traces, if it traces
    bool operator==(const KernelVariant&) const = default;
};

// The variants that the phases run, each once. `classes`: of the scene's materials, for Schedule::hosted;
// `accelerator`: one of kKernelAccelerators.
[[nodiscard]] std::vector<KernelVariant> kernelVariants(std::span<const Phase> phases, Schedule schedule,
                                                        const MaterialClasses& classes,
                                                        std::string_view accelerator = kBvh8);
// The name of the variant of a kernel for a class.
[[nodiscard]] std::string variantName(std::string_view kernel, const MaterialClass& materials);

using KernelMap = std::map<std::string, gpu::Kernel, std::less<>>;

// Kernels of a render, specialised, and compiled by the driver. No scene need be uploaded yet.
class EstimatorKernels {
  public:
    // `variants`: kernelVariants() of the render's phases; `planes`: filmPlanes() of its settings.
    EstimatorKernels(gpu::Device& device, std::vector<KernelVariant> variants,
                     const EstimatorSettings& settings, SceneFeatures features, uint32_t planes,
                     const KernelSource& source);

    // Names of the kernels whose code `source` changes. Throws Error as `source` does.
    [[nodiscard]] std::vector<std::string> changed(const KernelSource& source) const;
    // Compiles them, beside the ones that are in use. Throws Error.
    [[nodiscard]] KernelMap compileChanged(gpu::Device& device, const KernelSource& source) const;
    // Puts compiled kernels in the places of those of their names, which nothing may be bound to any more.
    void replace(KernelMap compiled) noexcept;

    // The variant must be one of those of the constructor.
    [[nodiscard]] const gpu::Kernel& operator[](std::string_view name) const;
    [[nodiscard]] const KernelMap& all() const { return kernels_; }
    // Whether they are what the constructor would make of these.
    [[nodiscard]] bool serve(std::span<const KernelVariant> variants, const EstimatorSettings& settings,
                             SceneFeatures features, uint32_t planes) const;
    // For another render, which they cost no time.
    [[nodiscard]] EstimatorKernels handOn() && {
        seconds_ = 0.0;
        return std::move(*this);
    }
    [[nodiscard]] std::span<const gpu::SpecialisationConstant> constants() const { return constants_; }
    // Seconds spent compiling these kernels.
    [[nodiscard]] double seconds() const { return seconds_; }

  private:
    // The file in shaders/kernels that a variant is compiled of.
    [[nodiscard]] std::string_view fileOf(const KernelVariant& variant) const;
    // The name by which a source knows it.
    [[nodiscard]] std::string sourceName(const KernelVariant& variant) const;
    [[nodiscard]] bool isChanged(const KernelVariant& variant, const KernelSource& source) const;
    [[nodiscard]] std::vector<gpu::SpecialisationConstant> constantsOf(const KernelVariant& variant) const;
    // On all processors. Throws Error as `source` does.
    [[nodiscard]] KernelMap compile(gpu::Device& device, std::span<const KernelVariant* const> variants,
                                    const KernelSource& source) const;

    EstimatorSettings settings_;
    SceneFeatures features_;
    uint32_t planes_;
    std::vector<gpu::SpecialisationConstant> constants_; // of all features
    std::vector<KernelVariant> variants_;
    KernelMap kernels_;
    double seconds_ = 0.0;
};

} // namespace lavalight
