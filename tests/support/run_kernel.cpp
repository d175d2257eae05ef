#include "support/run_kernel.h"

#include <utility>

#include "gpu/buffer.h"
#include "gpu/commands.h"

namespace lavalight::test {

KernelRunner::KernelRunner(gpu::Device& device, gpu::KernelCode code, gpu::ResourceTable others,
                           std::span<const gpu::SpecialisationConstant> constants)
    : device_(&device), kernel_(device, std::move(code), constants), others_(std::move(others)) {}

void KernelRunner::runBytes(std::span<const std::byte> in, std::span<std::byte> out, size_t invocations,
                            std::span<const std::byte> push) {
    gpu::Buffer input(*device_, "test input", in.size(), gpu::BufferUse::storage);
    gpu::Buffer output(*device_, "test output", out.size(), gpu::BufferUse::storage);
    input.upload(in);
    gpu::ResourceTable resources = others_;
    resources.set("In", input);
    resources.set("Out", output);
    const gpu::BoundKernel bound(*device_, kernel_, resources);
    gpu::Commands commands(*device_);
    commands.begin();
    commands.fill(output, 0);
    commands.dispatch(bound, static_cast<uint32_t>((invocations + 63) / 64), push);
    commands.submitAndWait();
    output.download(out);
}

} // namespace lavalight::test
