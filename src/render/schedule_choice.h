// Which schedule a render has where its settings leave that to the device, and what follows from it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "device_scene/accelerator.h"
#include "gpu/device.h"
#include "kernels/kernel_source.h"
#include "render/settings.h"

namespace lavalight {

// Fills in schedule, accelerator and wave size where the settings leave them to the device. The host traces
// as the embedded kernels do: where `source` has others, Schedule::hosted becomes Schedule::fused. Its waves
// have at most 931,919 slots. Throws Error where Schedule::hosted is asked for and the device does not share
// its memory, where the accelerator is not one of the schedule's or the device's, and as `source` does.
[[nodiscard]] RenderSettings resolveSchedule(RenderSettings settings, const gpu::DeviceDescription& device,
                                             const KernelSource& source = embeddedKernel);

// A message if `asked` lets the host trace on the device and `source` keeps it from that; else nothing.
[[nodiscard]] std::string whyNotHosted(const RenderSettings& asked, const gpu::DeviceDescription& device,
                                       const KernelSource& source);

// Names of the kernels on which an image depends: for Schedule::hosted also those that the host replaces, and
// those of the schedule that takes over. The settings must be resolved.
[[nodiscard]] std::vector<std::string> decisiveKernels(const RenderSettings& settings);

// The settings must be resolved.
[[nodiscard]] AcceleratorKind acceleratorOf(const RenderSettings& settings);

} // namespace lavalight
