#include "gpu/warm_up.h"

#include <deque>
#include <vector>

#include "gpu/commands.h"

namespace lavalight::gpu {
namespace {

constexpr uint64_t kUniformBytes = 16384; // as much as any kernel declares

// One buffer for every binding of a kind: no invocation looks at them. But lavapipe looks at uniforms, and
// may compile a kernel for the values of those that its branches depend on. What happens to lie in memory
// would have it compile anew in every other run, past its cache.
struct Dummies {
    explicit Dummies(Device& device)
        : texels(device, "warm-up texels", 0, BufferUse::texels),
          storage(device, "warm-up storage", 0, BufferUse::storage),
          uniform(device, "warm-up uniforms", kUniformBytes, BufferUse::uniform) {
        uniform.upload(std::span<const std::byte>(std::vector<std::byte>(kUniformBytes)));
    }

    [[nodiscard]] const Buffer& of(BindingKind kind) const {
        return kind == BindingKind::uniformTexelBuffer ? texels
               : kind == BindingKind::storageBuffer    ? storage
                                                       : uniform;
    }

    Buffer texels, storage, uniform;
};

} // namespace

void warmUp(Device& device, std::span<const Kernel* const> kernels) {
    const Dummies buffers(device);
    std::deque<BoundKernel> bound; // at fixed addresses, until all is done
    Commands commands(device);
    commands.begin();
    for (const Kernel* kernel : kernels) {
        ResourceTable resources;
        for (const KernelBinding& binding : kernel->code().bindings)
            resources.set(binding.name, buffers.of(binding.kind));
        const std::vector<std::byte> parameters(kernel->code().pushConstantBytes);
        commands.dispatch(bound.emplace_back(device, *kernel, resources), 0, parameters);
    }
    commands.submitAndWait();
}

} // namespace lavalight::gpu
