// Compute kernels: pipelines from SPIR-V with specialisation constants, and kernels bound to their buffers.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/shader_build.h"
#include "gpu/spirv_passes.h"

namespace lavalight::gpu {

class TriangleStructure;

// A compiled pipeline. Immutable after construction.
class Kernel {
  public:
    // Throws Error naming the kernel where the driver refuses it, or it declares more buffers than the device
    // allows.
    Kernel(const Device& device, KernelCode code, std::span<const SpecialisationConstant> constants = {});

    [[nodiscard]] const std::string& name() const { return code_.name; }
    [[nodiscard]] const KernelCode& code() const { return code_; }
    [[nodiscard]] vk::Pipeline pipeline() const { return *pipeline_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *setLayout_; }

  private:
    KernelCode code_;
    vk::raii::DescriptorSetLayout setLayout_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline pipeline_ = nullptr;
};

// Buffers and acceleration structures under the names that kernels declare them by. They must outlive the
// table and what is bound from it.
class ResourceTable {
  public:
    void set(std::string_view name, const Buffer& buffer) {
        buffers_.insert_or_assign(std::string(name), &buffer);
    }
    void set(std::string_view name, const TriangleStructure& structure) {
        structures_.insert_or_assign(std::string(name), &structure);
    }
    // Both throw std::logic_error for a name that was never set: a bug in the caller.
    [[nodiscard]] const Buffer& get(std::string_view name) const;
    [[nodiscard]] const TriangleStructure& structure(std::string_view name) const;

  private:
    std::map<std::string, const Buffer*, std::less<>> buffers_;
    std::map<std::string, const TriangleStructure*, std::less<>> structures_;
};

// A kernel with its descriptor set filled from a table by the names in the shader. The kernel must outlive
// it.
class BoundKernel {
  public:
    BoundKernel(const Device& device, const Kernel& kernel, const ResourceTable& resources);

    [[nodiscard]] const Kernel& kernel() const { return *kernel_; }
    [[nodiscard]] vk::DescriptorSet set() const { return *sets_.front(); }

  private:
    const Kernel* kernel_;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> sets_; // exactly one
};

} // namespace lavalight::gpu
