#include "kernels/kernel_source.h"

#include "embedded_kernels.h"
#include "kernels/accelerator_name.h"

namespace lavalight {

gpu::KernelCode embeddedKernel(std::string_view name) {
    // A kernel that traces no rays is the same with every accelerator.
    return embedded_kernels::find(embedded_kernels::contains(name) ? name : parseKernelName(name).file);
}

} // namespace lavalight
