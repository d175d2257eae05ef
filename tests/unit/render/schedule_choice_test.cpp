// Which schedule and accelerator a render has on which device, and what is refused.
#include "render/schedule_choice.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"

namespace lavalight::test {
namespace {

gpu::DeviceDescription cpu() {
    gpu::DeviceDescription device;
    device.name = "a processor";
    device.isCpu = device.sharesMemory = true;
    return device;
}

gpu::DeviceDescription card(bool tracesRays) {
    gpu::DeviceDescription device;
    device.name = "a card";
    device.tracesRays = tracesRays;
    return device;
}

RenderSettings asked(Schedule schedule, RayAccelerator accelerator) {
    RenderSettings settings;
    settings.work.schedule = schedule;
    settings.work.accelerator = accelerator;
    return settings;
}

using Choice = std::pair<Schedule, RayAccelerator>;

Choice chosen(Schedule schedule, RayAccelerator accelerator, const gpu::DeviceDescription& device,
              const KernelSource& source = embeddedKernel) {
    const WorkSettings work = resolveSchedule(asked(schedule, accelerator), device, source).work;
    return {work.schedule, work.accelerator};
}

std::string refusal(Schedule schedule, RayAccelerator accelerator, const gpu::DeviceDescription& device) {
    try {
        (void)chosen(schedule, accelerator, device);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

constexpr Schedule kAuto = Schedule::automatic;
constexpr RayAccelerator kAny = RayAccelerator::automatic;

TEST(ScheduleChoice, DevicesChooseByWhatTheyAre) {
    gpu::DeviceDescription apart = cpu(); // a CPU whose memory the host does not reach
    apart.sharesMemory = false;
    EXPECT_EQ(chosen(kAuto, kAny, cpu()), Choice(Schedule::hosted, RayAccelerator::bvh16));
    EXPECT_EQ(chosen(kAuto, kAny, apart), Choice(Schedule::fused, RayAccelerator::bvh8));
    EXPECT_EQ(chosen(kAuto, kAny, card(false)), Choice(Schedule::wavefront, RayAccelerator::bvh8));
    EXPECT_EQ(chosen(kAuto, kAny, card(true)), Choice(Schedule::wavefront, RayAccelerator::rayQuery));
}

// A CPU's driver traverses its structure more slowly than our kernels traverse ours.
TEST(ScheduleChoice, ACpuThatTracesRaysIsNotAskedTo) {
    gpu::DeviceDescription device = cpu();
    device.tracesRays = true;
    EXPECT_EQ(chosen(kAuto, kAny, device), Choice(Schedule::hosted, RayAccelerator::bvh16));
    EXPECT_EQ(chosen(Schedule::fused, kAny, device), Choice(Schedule::fused, RayAccelerator::bvh8));
    EXPECT_EQ(chosen(kAuto, RayAccelerator::rayQuery, device),
              Choice(Schedule::fused, RayAccelerator::rayQuery));
}

TEST(ScheduleChoice, AnAcceleratorDecidesAScheduleThatIsLeftOpen) {
    EXPECT_EQ(chosen(kAuto, RayAccelerator::bvh8, cpu()), Choice(Schedule::fused, RayAccelerator::bvh8));
    for (const RayAccelerator accelerator : {RayAccelerator::bvh16, RayAccelerator::embree})
        EXPECT_EQ(chosen(kAuto, accelerator, cpu()), Choice(Schedule::hosted, accelerator));
    EXPECT_EQ(chosen(kAuto, RayAccelerator::bvh8, card(true)),
              Choice(Schedule::wavefront, RayAccelerator::bvh8));
}

TEST(ScheduleChoice, RefusalsSayWhyAndWhatToTry) {
    EXPECT_EQ(refusal(kAuto, RayAccelerator::rayQuery, card(false)),
              "cannot use the accelerator ray-query: a card has no VK_KHR_ray_query; try --accelerator auto");
    EXPECT_EQ(refusal(Schedule::hosted, kAny, card(true)),
              "cannot use the schedule hosted: the host does not reach the memory of a card; try --schedule "
              "auto");
    EXPECT_EQ(refusal(Schedule::hosted, RayAccelerator::bvh8, cpu()),
              "cannot use the accelerator bvh8 with the schedule hosted: the host traces its rays; try "
              "--schedule fused");
    EXPECT_EQ(refusal(kAuto, RayAccelerator::embree, card(true)),
              "cannot use the accelerator embree: the host does not reach the memory of a card; try "
              "--accelerator auto");
    EXPECT_EQ(refusal(kAuto, RayAccelerator::bvh16, card(true)),
              "cannot use the accelerator bvh16: the host does not reach the memory of a card; try "
              "--accelerator auto");
    EXPECT_EQ(refusal(Schedule::fused, RayAccelerator::embree, cpu()),
              "cannot use the accelerator embree with the schedule fused: kernels trace its rays; try "
              "--schedule hosted");
}

// The host runs what the build embedded.
TEST(ScheduleChoice, KernelsTraceWhereAnyKernelThatTheHostReplacesIsEdited) {
    for (const std::string_view edited : {"extend", "connect", "hosted/proposed"}) {
        const KernelSource source = [&](std::string_view name) {
            gpu::KernelCode code = embeddedKernel(name);
            code.content += name == edited ? "edited" : "";
            return code;
        };
        EXPECT_EQ(chosen(kAuto, RayAccelerator::embree, cpu(), source),
                  Choice(Schedule::fused, RayAccelerator::bvh8))
            << edited;
        EXPECT_NE(whyNotHosted(asked(kAuto, kAny), cpu(), source), "");
        EXPECT_EQ(whyNotHosted(asked(kAuto, RayAccelerator::bvh8), cpu(), source), "");
    }
}

TEST(ScheduleChoice, AnImageDependsOnTheKernelsOfItsAccelerator) {
    const RenderSettings settings = resolveSchedule(asked(kAuto, kAny), card(true));
    const std::vector<std::string> kernels = decisiveKernels(settings);
    EXPECT_NE(std::ranges::find(kernels, "extend@ray_query"), kernels.end());
    EXPECT_EQ(std::ranges::find(kernels, "extend"), kernels.end());
}

} // namespace
} // namespace lavalight::test
