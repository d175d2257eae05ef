#include "render/wavefront.h"

#include <algorithm>
#include <cstddef>

namespace lavalight {
namespace {

// Bounces recorded before the host looks whether any path is left: a dispatch without work costs some 50 us
// on lavapipe, a look some 200 us.
constexpr uint32_t kBouncesPerSubmission = 8;

} // namespace

Wavefront::State::State(gpu::Device& device, uint32_t slots, uint32_t maxBounces)
    : rays(device, "rays", slots * sizeof(Ray), gpu::BufferUse::storage),
      hits(device, "hits", slots * sizeof(Hit), gpu::BufferUse::storage),
      paths(device, "paths", slots * sizeof(Path), gpu::BufferUse::storage),
      shadowRays(device, "shadow rays", slots * sizeof(ShadowRay), gpu::BufferUse::storage),
      queues(device, "queues", 3 * slots * sizeof(uint32_t), gpu::BufferUse::storage),
      counters(device, "bounce counters", (maxBounces + 2) * sizeof(BounceCounters),
               gpu::BufferUse::readback),
      dispatchSizes(device, "dispatch sizes", 2 * sizeof(DispatchSize), gpu::BufferUse::storage) {}

gpu::ResourceTable Wavefront::State::table() const {
    gpu::ResourceTable resources;
    resources.set("Rays", rays);
    resources.set("Hits", hits);
    resources.set("Paths", paths);
    resources.set("ShadowRays", shadowRays);
    resources.set("Queues", queues);
    resources.set("Counters", counters);
    resources.set("DispatchSizes", dispatchSizes);
    return resources;
}

Wavefront::Band::Band(gpu::Device& device, const State& state, const WaveInputs& inputs, const FilmBand& film)
    : resources(device, inputs, film, state.table()),
      generate(device, inputs.kernel("generate"), resources.table),
      extend(device, inputs.kernel("extend"), resources.table),
      shade(device, inputs.kernel("shade"), resources.table),
      prepare(device, inputs.kernel("prepare"), resources.table),
      connect(device, inputs.kernel("connect"), resources.table),
      accumulate(device, inputs.kernel("accumulate"), resources.table) {}

Wavefront::Wavefront(gpu::Device& device, const WaveInputs& inputs)
    : WaveRenderer(device), maxBounces_(inputs.frame.maxBounces),
      state_(device, inputs.frame.waveSize, maxBounces_) {
    bands_.reserve(inputs.film.bands().size());
    for (const FilmBand& band : inputs.film.bands())
        bands_.emplace_back(device, state_, inputs, band);
}

void Wavefront::renderWave(size_t bandIndex, WaveRange range) {
    const Band& band = bands_[bandIndex];
    commands_.begin();
    commands_.fill(state_.counters, 0);
    commands_.dispatch(band.generate, groupsFor(range.pixelCount * range.sampleCount), pushed(range));
    for (uint32_t bounce = 0; bounce <= maxBounces_; ++bounce) {
        if (bounce > 0 && bounce % kBouncesPerSubmission == 0) {
            commands_.submitAndWait();
            commands_.begin();
            if (state_.counters.downloadAll<BounceCounters>()[bounce].rays == 0)
                break;
        }
        recordBounce(band, range, bounce);
    }
    commands_.dispatch(band.accumulate, groupsFor(range.pixelCount), pushed(range));
    commands_.submitAndWait();
    countRays();
}

void Wavefront::recordBounce(const Band& band, WaveRange range, uint32_t bounce) {
    constexpr uint64_t connectSize = 0;
    constexpr uint64_t raySize = sizeof(DispatchSize);
    range.bounce = bounce;
    if (bounce == 0) {
        const uint32_t groups = groupsFor(range.pixelCount * range.sampleCount);
        commands_.dispatch(band.extend, groups, pushed(range));
        commands_.dispatch(band.shade, groups, pushed(range));
    } else {
        commands_.dispatchIndirect(band.extend, state_.dispatchSizes, raySize, pushed(range));
        commands_.dispatchIndirect(band.shade, state_.dispatchSizes, raySize, pushed(range));
    }
    commands_.dispatch(band.prepare, 1, pushed(range));
    commands_.dispatchIndirect(band.connect, state_.dispatchSizes, connectSize, pushed(range));
}

void Wavefront::countRays() {
    const auto counters = state_.counters.downloadAll<BounceCounters>();
    raysPerBounce_.resize(counters.size());
    rays_.camera += counters.front().rays;
    for (size_t bounce = 0; bounce < counters.size(); ++bounce) {
        raysPerBounce_[bounce] += counters[bounce].rays;
        rays_.indirect += bounce > 0 ? counters[bounce].rays : 0;
        rays_.shadow += counters[bounce].shadowRays;
    }
}

} // namespace lavalight
