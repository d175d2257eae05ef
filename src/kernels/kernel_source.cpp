#include "kernels/kernel_source.h"

#include <algorithm>

#include "embedded_kernels.h"
#include "kernels/accelerator_name.h"

namespace lavalight {

gpu::KernelCode embeddedKernel(std::string_view name) {
    const KernelName parsed = parseKernelName(name);
    const bool isKnown =
        std::ranges::find(kKernelAccelerators, parsed.accelerator) != kKernelAccelerators.end();
    // A kernel that is not there with an accelerator traces no rays: it is the same with all.
    return embedded_kernels::find(!isKnown || embedded_kernels::contains(name) ? name : parsed.file);
}

} // namespace lavalight
