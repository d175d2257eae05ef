// Runs a test kernel over host data: vectors in, vectors out.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "gpu/device.h"
#include "gpu/kernel.h"

namespace lavalight::test {

// A test kernel reads the storage block `In`, writes one element of the storage block `Out` per invocation
// (64 to a workgroup; those beyond its length do nothing) and has whatever push constants it likes. It may
// leave out `In`.
class KernelRunner {
  public:
    // `others` are the buffers besides In and Out, under the names of the kernel; they must outlive the
    // runner.
    KernelRunner(gpu::Device& device, gpu::KernelCode code, gpu::ResourceTable others = {},
                 std::span<const gpu::SpecialisationConstant> constants = {});

    // Returns `count` outputs. `push` must be as long as the kernel's push constants.
    template <typename Out, typename In>
    [[nodiscard]] std::vector<Out> run(std::span<const In> in, size_t count,
                                       std::span<const std::byte> push = {}) {
        static_assert(std::is_trivially_copyable_v<In> && std::is_trivially_copyable_v<Out>);
        std::vector<Out> out(count);
        runBytes(std::as_bytes(in), std::as_writable_bytes(std::span(out)), count, push);
        return out;
    }
    // Returns one output per input.
    template <typename Out, typename In>
    [[nodiscard]] std::vector<Out> map(const std::vector<In>& in) {
        return run<Out>(std::span<const In>(in), in.size());
    }
    // Returns outputs from push constants alone.
    template <typename Out, typename Push>
    [[nodiscard]] std::vector<Out> generate(size_t count, const Push& push) {
        return run<Out>(std::span<const std::byte>(), count, std::as_bytes(std::span(&push, 1)));
    }

  private:
    void runBytes(std::span<const std::byte> in, std::span<std::byte> out, size_t invocations,
                  std::span<const std::byte> push);

    gpu::Device* device_; // outlives the runner
    gpu::Kernel kernel_;
    gpu::ResourceTable others_;
};

} // namespace lavalight::test
