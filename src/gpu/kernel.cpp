#include "gpu/kernel.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "base/content_hash.h"
#include "base/error.h"
#include "base/user_cache.h"
#include "gpu/texel_storage.h"
#include "gpu/triangle_structure.h"

namespace lavalight::gpu {
namespace {

vk::DescriptorType descriptorType(BindingKind kind) {
    switch (kind) {
    case BindingKind::storageBuffer:
        return vk::DescriptorType::eStorageBuffer;
    case BindingKind::uniformBuffer:
        return vk::DescriptorType::eUniformBuffer;
    case BindingKind::uniformTexelBuffer:
        return vk::DescriptorType::eUniformTexelBuffer;
    case BindingKind::accelerationStructure:
        return vk::DescriptorType::eAccelerationStructureKHR;
    }
    throw std::logic_error("a binding of an unknown kind");
}

vk::raii::DescriptorSetLayout makeSetLayout(const Device& device, const KernelCode& code) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const KernelBinding& binding : code.bindings)
        bindings.emplace_back(binding.binding, descriptorType(binding.kind), 1,
                              vk::ShaderStageFlagBits::eCompute);
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout makeLayout(const Device& device, const KernelCode& code,
                                    vk::DescriptorSetLayout setLayout) {
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, code.pushConstantBytes);
    vk::PipelineLayoutCreateInfo info({}, setLayout);
    if (code.pushConstantBytes > 0)
        info.setPushConstantRanges(range);
    return {device.handle(), info};
}

// What specialised() makes of the code, which the user's cache has where it was made before: it takes half of
// the time until the first sample of a small scene.
std::vector<uint32_t> specialisedOnce(const KernelCode& code,
                                      std::span<const SpecialisationConstant> constants) {
    constexpr uint64_t kMostBytes = 128u << 20;
    const UserCache cache(userCacheFolder("kernels"), kMostBytes);
    static const std::string passes = specialisingPasses();
    const std::vector<SpecialisationConstant> declared = declaredIn(code.spirv, constants);
    ContentHash hash;
    hash.add(passes);
    hash.add(code.spirv);
    hash.add(declared);
    const std::string key = hash.text();
    if (const std::optional<std::string> kept = cache.find(key)) {
        std::vector<uint32_t> spirv(kept->size() / sizeof(uint32_t));
        std::memcpy(spirv.data(), kept->data(), spirv.size() * sizeof(uint32_t));
        return spirv;
    }
    std::vector<uint32_t> spirv = specialised(code.spirv, declared);
    cache.keep(key, {reinterpret_cast<const char*>(spirv.data()), spirv.size() * sizeof(uint32_t)});
    return spirv;
}

vk::raii::Pipeline makePipeline(const Device& device, const KernelCode& code, vk::PipelineLayout layout,
                                std::span<const SpecialisationConstant> constants) {
    const std::vector<uint32_t> spirv = specialisedOnce(code, constants);
    const vk::ShaderModuleCreateInfo moduleInfo({}, spirv);
    const vk::raii::ShaderModule shader(device.handle(), moduleInfo);
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader, "main");
    return {device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, layout)};
}

uint32_t countOf(const KernelCode& code, BindingKind kind) {
    return static_cast<uint32_t>(std::ranges::count(code.bindings, kind, &KernelBinding::kind));
}

void checkLimits(const Device& device, const KernelCode& code) {
    const auto check = [&](BindingKind kind, uint32_t most, const char* words) {
        if (countOf(code, kind) > most)
            throw Error(fmt::format("cannot build kernel {}: it declares {} {} buffers, and {} allows {}",
                                    code.name, countOf(code, kind), words, device.description().name, most));
    };
    check(BindingKind::storageBuffer, device.limits().maxStorageBuffers, "storage");
    check(BindingKind::uniformTexelBuffer, device.limits().maxTexelBuffers, "texel");
}

KernelCode codeFor(const Device& device, KernelCode code) {
    if (device.storesTexels())
        code = withTexelsInStorage(std::move(code));
    checkLimits(device, code);
    return code;
}

} // namespace

Kernel::Kernel(const Device& device, KernelCode code, std::span<const SpecialisationConstant> constants)
    : code_(codeFor(device, std::move(code))) {
    checked("build kernel", code_.name, [&] {
        setLayout_ = makeSetLayout(device, code_);
        layout_ = makeLayout(device, code_, *setLayout_);
        pipeline_ = makePipeline(device, code_, *layout_, constants);
    });
}

namespace {

template <typename Resource>
const Resource& findIn(const std::map<std::string, const Resource*, std::less<>>& resources,
                       std::string_view name) {
    const auto found = resources.find(name);
    if (found == resources.end())
        throw std::logic_error(fmt::format("no resource is set under the name {}", name));
    return *found->second;
}

} // namespace

const Buffer& ResourceTable::get(std::string_view name) const {
    return findIn(buffers_, name);
}

const TriangleStructure& ResourceTable::structure(std::string_view name) const {
    return findIn(structures_, name);
}

BoundKernel::BoundKernel(const Device& device, const Kernel& kernel, const ResourceTable& resources)
    : kernel_(&kernel) {
    const std::vector<KernelBinding>& bindings = kernel.code().bindings;
    std::vector<vk::DescriptorPoolSize> sizes;
    std::vector<vk::DescriptorBufferInfo> buffers(bindings.size());
    std::vector<vk::BufferView> views(bindings.size());
    std::vector<vk::AccelerationStructureKHR> handles(bindings.size());
    std::vector<vk::WriteDescriptorSetAccelerationStructureKHR> structures(bindings.size());
    std::vector<vk::WriteDescriptorSet> writes;
    for (size_t i = 0; i < bindings.size(); ++i) {
        const std::string& name = bindings[i].name;
        const vk::DescriptorType type = descriptorType(bindings[i].kind);
        sizes.emplace_back(type, 1);
        vk::WriteDescriptorSet write({}, bindings[i].binding, 0, 1, type);
        if (bindings[i].kind == BindingKind::uniformTexelBuffer) {
            views[i] = resources.get(name).texelView();
            write.setTexelBufferView(views[i]);
        } else if (bindings[i].kind == BindingKind::accelerationStructure) {
            handles[i] = resources.structure(name).handle();
            structures[i].setAccelerationStructures(handles[i]);
            write.setPNext(&structures[i]);
        } else {
            buffers[i] = vk::DescriptorBufferInfo(resources.get(name).handle(), 0, VK_WHOLE_SIZE);
            write.setBufferInfo(buffers[i]);
        }
        writes.push_back(write);
    }
    if (sizes.empty())
        sizes.emplace_back(vk::DescriptorType::eStorageBuffer, 1);
    checked("bind kernel", kernel.name(), [&] {
        pool_ = vk::raii::DescriptorPool(
            device.handle(),
            vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes));
        const vk::DescriptorSetLayout layout = kernel.setLayout();
        for (auto& set :
             vk::raii::DescriptorSets(device.handle(), vk::DescriptorSetAllocateInfo(*pool_, layout)))
            sets_.push_back(std::move(set));
        for (vk::WriteDescriptorSet& write : writes)
            write.setDstSet(*sets_.front());
        device.handle().updateDescriptorSets(writes, {});
    });
}

} // namespace lavalight::gpu
