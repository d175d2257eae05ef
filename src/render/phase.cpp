#include "render/phase.h"

#include <algorithm>
#include <cassert>

namespace lavalight {

std::vector<Phase> phasesOf(const RenderSettings& settings) {
    return {{&kPathTransport, settings.image.firstSample, settings.stop.samples}};
}

std::vector<std::string_view> kernelNames(std::span<const Phase> phases, Schedule schedule) {
    assert(schedule != Schedule::automatic);
    std::vector<std::string_view> names;
    const auto add = [&](std::string_view name) {
        if (std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    };
    for (const Phase& phase : phases) {
        const Transport& transport = *phase.transport;
        const HostedKernels& hosted = transport.hosted;
        if (schedule == Schedule::fused)
            add(transport.fusedKernel);
        else if (schedule == Schedule::hosted)
            for (const std::string_view kernel : {hosted.camera, hosted.scatter, hosted.escape})
                add(kernel);
        else
            for (const std::span<const KernelStep> steps : {transport.start, transport.bounce})
                for (const KernelStep& step : steps)
                    add(step.kernel);
        add(transport.sink.kernel);
    }
    return names;
}

std::vector<std::string_view> kernelNames(const RenderSettings& settings) {
    return kernelNames(phasesOf(settings), settings.work.schedule);
}

} // namespace lavalight
