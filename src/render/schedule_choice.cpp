#include "render/schedule_choice.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

#include "base/error.h"
#include "hosted/host_rays.h"
#include "render/phase.h"
#include "render/setting_names.h"
#include "shared/records.h"

namespace lavalight {
namespace {

// Slots of a wave where the settings leave it open. On lavapipe with two threads, larger waves make the fused
// kernel no faster, and the wavefront by a tenth at 2^20; --time and Ctrl-C wait for the end of a wave.
constexpr uint32_t kWaveSize = 1u << 18;

// The most records of a wave, whose planes lie in one buffer: every device allows 128 MiB.
constexpr uint32_t kMostRecords = (1u << 27) / (kPlanesOut * sizeof(glm::uvec4)) - kPlanePadding;

// The schedule that takes over where kernels must trace on a CPU.
constexpr Schedule kInsteadOfHosted = Schedule::fused;

} // namespace

RenderSettings resolveSchedule(RenderSettings settings, const gpu::DeviceDescription& device,
                               const KernelSource& source) {
    Schedule& schedule = settings.work.schedule;
    if (schedule == Schedule::hosted && !device.sharesMemory)
        throw Error(
            fmt::format("cannot use the schedule hosted: the host does not reach the memory of {}; try "
                        "--schedule auto",
                        device.name));
    if (schedule == Schedule::automatic)
        schedule = device.sharesMemory ? Schedule::hosted
                   : device.isCpu      ? Schedule::fused
                                       : Schedule::wavefront;
    if (schedule == Schedule::hosted && !tracesAsHost(source))
        schedule = kInsteadOfHosted;
    if (settings.work.waveSize == 0)
        settings.work.waveSize = kWaveSize;
    if (schedule == Schedule::hosted)
        settings.work.waveSize = std::min(settings.work.waveSize, kMostRecords);
    return settings;
}

std::string whyNotHosted(const RenderSettings& asked, const gpu::DeviceDescription& device,
                         const KernelSource& source) {
    const bool mayBeHosted =
        asked.work.schedule == Schedule::hosted || asked.work.schedule == Schedule::automatic;
    if (!mayBeHosted || !device.sharesMemory || tracesAsHost(source))
        return {};
    return fmt::format("edited shaders take part in tracing rays, and the host does not know of them: the "
                       "schedule is {} instead of {}",
                       nameOf(kInsteadOfHosted), nameOf(Schedule::hosted));
}

std::vector<std::string_view> decisiveKernels(const RenderSettings& settings) {
    std::vector<std::string_view> names = kernelNames(settings);
    if (settings.work.schedule != Schedule::hosted)
        return names;
    names.insert(names.end(), kTracingKernels.begin(), kTracingKernels.end());
    const std::vector<std::string_view> instead = kernelNames(phasesOf(settings), kInsteadOfHosted);
    names.insert(names.end(), instead.begin(), instead.end());
    return names;
}

AcceleratorKind acceleratorOf(const RenderSettings& settings) {
    assert(settings.work.schedule != Schedule::automatic);
    return settings.work.schedule == Schedule::hosted ? AcceleratorKind::embree : AcceleratorKind::bvh8;
}

} // namespace lavalight
