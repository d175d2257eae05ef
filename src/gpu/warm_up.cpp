#include "gpu/warm_up.h"

#include <deque>
#include <vector>

#include "gpu/commands.h"

namespace lavalight::gpu {
namespace {

constexpr uint64_t kUniformBytes = 16384; // as much as any kernel declares

const Buffer& addBuffer(Device& device, BindingKind kind, std::deque<Buffer>& buffers) {
    switch (kind) {
    case BindingKind::uniformTexelBuffer:
        return buffers.emplace_back(device, "warm-up texels", 0, BufferUse::texels);
    case BindingKind::storageBuffer:
        return buffers.emplace_back(device, "warm-up storage", 0, BufferUse::storage);
    case BindingKind::uniformBuffer:
        break;
    }
    return buffers.emplace_back(device, "warm-up uniforms", kUniformBytes, BufferUse::uniform);
}

} // namespace

void warmUp(Device& device, std::span<const Kernel* const> kernels) {
    std::deque<Buffer> buffers; // at fixed addresses, until all is done
    std::deque<BoundKernel> bound;
    Commands commands(device);
    commands.begin();
    for (const Kernel* kernel : kernels) {
        ResourceTable resources;
        for (const KernelBinding& binding : kernel->code().bindings)
            resources.set(binding.name, addBuffer(device, binding.kind, buffers));
        const std::vector<std::byte> parameters(kernel->code().pushConstantBytes);
        commands.dispatch(bound.emplace_back(device, *kernel, resources), 0, parameters);
    }
    commands.submitAndWait();
}

} // namespace lavalight::gpu
