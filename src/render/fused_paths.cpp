#include "render/fused_paths.h"

#include <algorithm>
#include <numeric>

namespace lavalight {
namespace {

// The more slots a lane takes, the less it matters that paths differ in length: lanes that work in step wait
// for the longest sum, not for the longest path. Too few lanes leave processors idle.
constexpr uint32_t kMostSlotsPerLane = 64;
constexpr uint32_t kFewestLanes = 4096;

uint32_t slotsPerLane(uint32_t slots) {
    return std::clamp(slots / kFewestLanes, 1u, kMostSlotsPerLane);
}

// Most lanes that a wave of any size up to `slots` has, in whole workgroups.
uint32_t mostLanes(uint32_t slots) {
    const uint32_t lanes = std::max(std::min(slots, 2 * kFewestLanes), slots / kMostSlotsPerLane + 1);
    return groupsFor(lanes) * kWorkgroupSize;
}

// A number without a divisor in common with `groups`, near their golden section: multiples of it, modulo
// `groups`, are spread evenly however many of them there are.
uint32_t strideThrough(uint32_t groups) {
    auto stride = static_cast<uint32_t>(0.6180339887 * groups) + 1;
    while (std::gcd(stride, groups) != 1)
        ++stride;
    return stride;
}

} // namespace

FusedPaths::FusedPaths(gpu::Device& device, const WaveInputs& inputs)
    : state_(device, inputs),
      lanes_(device, "lanes", mostLanes(inputs.frame.waveSize) * sizeof(Lane), gpu::BufferUse::storage),
      counters_(device, "lane counters", sizeof(LaneCounters), gpu::BufferUse::readback), commands_(device) {
    bands_ = bindBands(device, inputs, table());
    commands_.begin();
    commands_.fill(lanes_, 0); // no lane belongs to a wave yet
    commands_.submitAndWait();
}

gpu::ResourceTable FusedPaths::table() const {
    gpu::ResourceTable resources;
    state_.addTo(resources);
    resources.set("Lanes", lanes_);
    resources.set("LaneCounts", counters_);
    return resources;
}

void FusedPaths::renderWave(const Transport& transport, size_t bandIndex, WaveRange range) {
    const BoundBand& band = bands_[bandIndex];
    const uint32_t slots = range.pixelCount * range.sampleCount;
    range.slotsPerLane = slotsPerLane(slots);
    range.wave = ++wave_;
    const uint32_t lanes = (slots + range.slotsPerLane - 1) / range.slotsPerLane;
    range.groupStride = strideThrough(groupsFor(lanes));
    while (advance(band[transport.fusedKernel], range, lanes) > 0) {
    }
    commands_.begin();
    commands_.dispatch(band[transport.sink.kernel], groupsFor(transport.sink.over, range), pushed(range));
    commands_.submitAndWait();
    rays_.camera += slots;
}

uint32_t FusedPaths::advance(const gpu::BoundKernel& paths, const WaveRange& range, uint32_t lanes) {
    commands_.begin();
    commands_.fill(counters_, 0);
    commands_.dispatch(paths, groupsFor(lanes), pushed(range));
    commands_.submitAndWait();
    const LaneCounters counters = counters_.downloadAll<LaneCounters>().front();
    rays_.indirect += counters.indirectRays;
    rays_.shadow += counters.shadowRays;
    return counters.unfinished;
}

} // namespace lavalight
