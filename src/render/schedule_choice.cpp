#include "render/schedule_choice.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "base/error.h"
#include "hosted/host_rays.h"
#include "render/phase.h"
#include "render/setting_names.h"
#include "render/setting_rules.h"
#include "render/wave_budget.h"
#include "shared/records.h"

namespace lavalight {
namespace {

// Slots of a wave where the settings leave it open. On lavapipe with two threads, larger waves make the fused
// kernel no faster, and the wavefront by a tenth at 2^20; --time and Ctrl-C wait for the end of a wave. The
// hosted schedule has many short submissions at the end of each wave, during which processors wait: twice
// the slots make it faster by up to 5 %.
constexpr uint32_t kWaveSize = WaveBudget::kFirstOnCpu;
constexpr uint32_t kHostedWaveSize = 2 * kWaveSize;

// The most records of a wave, whose planes lie in one buffer: every device allows 128 MiB.
constexpr uint32_t kMostRecords = (1u << 27) / (kPlanesOut * sizeof(glm::uvec4)) - kPlanePadding;

// The schedule that takes over where kernels must trace on a CPU.
constexpr Schedule kInsteadOfHosted = Schedule::fused;

bool letsHostTrace(RayAccelerator accelerator) {
    return accelerator == RayAccelerator::automatic || isOnHost(accelerator);
}

void requireRayQueries(RayAccelerator accelerator, const gpu::DeviceDescription& device) {
    if (accelerator == RayAccelerator::rayQuery && !device.tracesRays)
        throw Error(fmt::format("cannot use the accelerator ray-query: {} has no VK_KHR_ray_query; try "
                                "--accelerator auto",
                                device.name));
}

void requireHostedMemory(const char* what, std::string_view name, const char* instead,
                         const gpu::DeviceDescription& device) {
    if (!device.sharesMemory)
        throw Error(fmt::format("cannot use the {} {}: the host does not reach the memory of {}; try {}",
                                what, name, device.name, instead));
}

} // namespace

RenderSettings resolveSchedule(RenderSettings settings, const gpu::DeviceDescription& device,
                               const KernelSource& source) {
    Schedule& schedule = settings.work.schedule;
    RayAccelerator& accelerator = settings.work.accelerator;
    requireRayQueries(accelerator, device);
    if (schedule == Schedule::hosted)
        requireHostedMemory("schedule", nameOf(schedule), "--schedule auto", device);
    if (isOnHost(accelerator))
        requireHostedMemory("accelerator", nameOf(accelerator), "--accelerator auto", device);
    if (schedule == Schedule::automatic)
        schedule = device.sharesMemory && letsHostTrace(accelerator) ? Schedule::hosted
                   : device.isCpu                                    ? Schedule::fused
                                                                     : Schedule::wavefront;
    requireAgreement(schedule, accelerator);
    if (schedule == Schedule::hosted && !tracesAsHost(source)) {
        schedule = kInsteadOfHosted;
        accelerator = RayAccelerator::automatic;
    }
    if (accelerator == RayAccelerator::automatic)
        accelerator = schedule == Schedule::hosted         ? RayAccelerator::bvh16
                      : device.tracesRays && !device.isCpu ? RayAccelerator::rayQuery
                                                           : RayAccelerator::bvh8;
    if (settings.work.waveSize == 0)
        settings.work.waveSize = schedule == Schedule::hosted ? kHostedWaveSize : kWaveSize;
    if (schedule == Schedule::hosted)
        settings.work.waveSize = std::min(settings.work.waveSize, kMostRecords);
    return settings;
}

std::string whyNotHosted(const RenderSettings& asked, const gpu::DeviceDescription& device,
                         const KernelSource& source) {
    const Schedule schedule = asked.work.schedule;
    const bool mayBeHosted = (schedule == Schedule::hosted || schedule == Schedule::automatic) &&
                             letsHostTrace(asked.work.accelerator);
    if (!mayBeHosted || !device.sharesMemory || tracesAsHost(source))
        return {};
    return fmt::format("edited shaders take part in tracing rays, and the host does not know of them: the "
                       "schedule is {} instead of {}",
                       nameOf(kInsteadOfHosted), nameOf(Schedule::hosted));
}

std::vector<std::string> decisiveKernels(const RenderSettings& settings) {
    std::vector<std::string> names;
    const auto add = [&](std::span<const std::string_view> files, AcceleratorKind kind) {
        for (const std::string_view file : files)
            names.push_back(textOf({file, kernelAccelerator(kind)}));
    };
    add(kernelNames(settings), acceleratorOf(settings));
    if (settings.work.schedule == Schedule::hosted) {
        add(kTracingKernels, AcceleratorKind::bvh8);
        add(kernelNames(phasesOf(settings), kInsteadOfHosted), AcceleratorKind::bvh8);
    }
    return names;
}

AcceleratorKind acceleratorOf(const RenderSettings& settings) {
    switch (settings.work.accelerator) {
    case RayAccelerator::bvh16:
        return AcceleratorKind::bvh16;
    case RayAccelerator::embree:
        return AcceleratorKind::embree;
    case RayAccelerator::rayQuery:
        return AcceleratorKind::rayQuery;
    case RayAccelerator::bvh8:
        return AcceleratorKind::bvh8;
    case RayAccelerator::automatic:
        break;
    }
    throw std::logic_error("an accelerator that is not resolved");
}

} // namespace lavalight
