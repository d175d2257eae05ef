// Compiling kernels ahead of their first use.
#pragma once

#include <span>

#include "gpu/device.h"
#include "gpu/kernel.h"

namespace lavalight::gpu {

// Runs dispatches of no workgroups, with buffers of no meaning. Drivers for CPUs generate a kernel's machine
// code at its first dispatch: this takes that time out of the first that counts, and may run beside work on
// the host.
void warmUp(Device& device, std::span<const Kernel* const> kernels);

} // namespace lavalight::gpu
