#include "gpu/warm_up.h"

#include <deque>
#include <optional>
#include <vector>

#include "gpu/commands.h"
#include "gpu/triangle_structure.h"

namespace lavalight::gpu {
namespace {

constexpr uint64_t kUniformBytes = 16384; // as much as any kernel declares

// One buffer for every binding of a kind: no invocation looks at them. But lavapipe looks at uniforms, and
// may compile a kernel for the values of those that its branches depend on. What happens to lie in memory
// would have it compile anew in every other run, past its cache.
struct Dummies {
    explicit Dummies(Device& onDevice)
        : device(&onDevice), texels(onDevice, "warm-up texels", 0, BufferUse::texels),
          storage(onDevice, "warm-up storage", 0, BufferUse::storage),
          uniform(onDevice, "warm-up uniforms", kUniformBytes, BufferUse::uniform) {
        uniform.upload(std::span<const std::byte>(std::vector<std::byte>(kUniformBytes)));
    }

    void addTo(ResourceTable& resources, const KernelBinding& binding) {
        if (binding.kind == BindingKind::accelerationStructure)
            resources.set(binding.name, structure ? *structure : structure.emplace(*device, storage, 0));
        else
            resources.set(binding.name, of(binding.kind));
    }

    [[nodiscard]] const Buffer& of(BindingKind kind) const {
        return kind == BindingKind::uniformTexelBuffer ? texels
               : kind == BindingKind::storageBuffer    ? storage
                                                       : uniform;
    }

    Device* device;
    Buffer texels, storage, uniform;
    std::optional<TriangleStructure> structure{}; // empty; of kernels that declare one
};

} // namespace

void warmUp(Device& device, std::span<const Kernel* const> kernels) {
    Dummies buffers(device);
    std::deque<BoundKernel> bound; // at fixed addresses, until all is done
    Commands commands(device);
    commands.begin();
    for (const Kernel* kernel : kernels) {
        ResourceTable resources;
        for (const KernelBinding& binding : kernel->code().bindings)
            buffers.addTo(resources, binding);
        const std::vector<std::byte> parameters(kernel->code().pushConstantBytes);
        commands.dispatch(bound.emplace_back(device, *kernel, resources), 0, parameters);
    }
    commands.submitAndWait();
}

} // namespace lavalight::gpu
