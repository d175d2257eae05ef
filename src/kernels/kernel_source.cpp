#include "kernels/kernel_source.h"

#include "embedded_kernels.h"

namespace lavalight {

gpu::KernelCode embeddedKernel(std::string_view name) {
    return embedded_kernels::find(name);
}

} // namespace lavalight
