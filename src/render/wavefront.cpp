#include "render/wavefront.h"

#include <algorithm>
#include <cstddef>

namespace lavalight {
namespace {

// Bounces recorded before the host looks whether any path is left: a dispatch without work costs some 50 us
// on lavapipe, a look some 200 us.
constexpr uint32_t kBouncesPerSubmission = 8;

} // namespace

Wavefront::Turn::Turn(gpu::Device& device, uint32_t maxBounces)
    : counters(device, "bounce counters", (maxBounces + 2) * sizeof(BounceCounters),
               gpu::BufferUse::readback) {}

gpu::ResourceTable Wavefront::tableOf(const Turn& turn) const {
    gpu::ResourceTable resources;
    state_.addTo(resources);
    resources.set("Queues", queues_);
    resources.set("Counters", turn.counters);
    resources.set("DispatchSizes", dispatchSizes_);
    return resources;
}

Wavefront::Wavefront(gpu::Device& device, const WaveInputs& inputs)
    : maxBounces_(inputs.frame.maxBounces), runsAhead_(device.runsAhead()), state_(device, inputs),
      queues_(device, "queues", 3 * inputs.frame.waveSize * sizeof(uint32_t), gpu::BufferUse::storage),
      dispatchSizes_(device, "dispatch sizes", 2 * sizeof(DispatchSize), gpu::BufferUse::storage) {
    const size_t turns = runsAhead_ ? 2 : 1;
    turns_.reserve(turns); // they stay at their addresses
    for (size_t i = 0; i < turns; ++i) {
        turns_.emplace_back(device, maxBounces_);
        commands_.emplace_back(device);
        bands_.push_back(bindBands(device, inputs, tableOf(turns_.back())));
    }
}

// Waits for the older of two submissions.
gpu::Commands& Wavefront::startRecording() {
    recording_ = (recording_ + 1) % commands_.size();
    commands_[recording_].begin();
    return commands_[recording_];
}

void Wavefront::submit(gpu::Commands& commands) const {
    commands.submit();
    if (!runsAhead_)
        commands.wait();
}

void Wavefront::renderWave(const Transport& transport, size_t bandIndex, WaveRange range) {
    gpu::Commands* commands = &startRecording();
    turn_ = (turn_ + 1) % turns_.size();
    Turn& turn = turns_[turn_];
    countRays(turn); // rays of the wave before the one before, which is done
    const BoundBand& band = bands_[turn_][bandIndex];
    commands->fill(turn.counters, 0);
    for (const KernelStep& step : transport.start)
        record(*commands, band, step, range);
    for (uint32_t bounce = 0; bounce <= maxBounces_; ++bounce) {
        if (bounce > 0 && bounce % kBouncesPerSubmission == 0) {
            submit(*commands);
            commands = &startRecording();
            if (isOver(turn, bounce))
                break;
        }
        range.bounce = bounce;
        for (const KernelStep& step : transport.bounce)
            record(*commands, band, step, range);
    }
    record(*commands, band, transport.sink, range);
    turn.isCounted = false;
    submit(*commands);
    if (!runsAhead_)
        countRays(turn);
}

void Wavefront::finish() {
    for (size_t i = 1; i <= commands_.size(); ++i) // the older first
        commands_[(recording_ + i) % commands_.size()].wait();
    for (Turn& turn : turns_)
        countRays(turn);
}

gpu::KernelTimes Wavefront::kernelTimes() const {
    gpu::KernelTimes sums;
    for (const gpu::Commands& commands : commands_)
        for (const auto& [name, time] : commands.times()) {
            sums[name].seconds += time.seconds;
            sums[name].dispatches += time.dispatches;
        }
    return sums;
}

// Whether no path is left at the newest bounce that is known to be done: the one just submitted, or the one a
// submission before. What was submitted for no path does nothing.
bool Wavefront::isOver(const Turn& turn, uint32_t bounce) const {
    const uint32_t known = runsAhead_ ? bounce - kBouncesPerSubmission : bounce;
    return known > 0 && turn.counters.downloadAll<BounceCounters>()[known].rays == 0;
}

// How long a queue is, the device alone knows; but at first every slot has a ray.
void Wavefront::record(gpu::Commands& commands, const BoundBand& band, const KernelStep& step,
                       const WaveRange& range) const {
    constexpr uint64_t shadowSize = 0;
    constexpr uint64_t raySize = sizeof(DispatchSize);
    if (step.over == Over::shadowRays)
        commands.dispatchIndirect(band[step.kernel], dispatchSizes_, shadowSize, pushed(range));
    else if (step.over == Over::rays && range.bounce > 0)
        commands.dispatchIndirect(band[step.kernel], dispatchSizes_, raySize, pushed(range));
    else
        commands.dispatch(band[step.kernel], groupsFor(step.over, range), pushed(range));
}

void Wavefront::countRays(Turn& turn) {
    if (turn.isCounted)
        return;
    turn.isCounted = true;
    const auto counters = turn.counters.downloadAll<BounceCounters>();
    raysPerBounce_.resize(counters.size());
    rays_.camera += counters.front().rays;
    for (size_t bounce = 0; bounce < counters.size(); ++bounce) {
        raysPerBounce_[bounce] += counters[bounce].rays;
        rays_.indirect += bounce > 0 ? counters[bounce].rays : 0;
        rays_.shadow += counters[bounce].shadowRays;
    }
}

} // namespace lavalight
