#include "render/fused_paths.h"

#include <algorithm>
#include <numeric>

#include "shared/features.h"

namespace lavalight {
namespace {

// The more slots a lane takes, the less it matters that paths differ in length: lanes that work in step wait
// for the longest sum, not for the longest path. Too few lanes leave processors idle.
constexpr uint32_t kMostSlotsPerLane = 64;
constexpr uint32_t kFewestLanes = 4096;

uint32_t slotsPerLane(uint32_t slots) {
    return std::clamp(slots / kFewestLanes, 1u, kMostSlotsPerLane);
}

// Of a wave of any size up to `slots`, in whole workgroups.
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

FusedPaths::State::State(gpu::Device& device, uint32_t slots, bool putsPathsBy)
    : paths(device, "paths", slots * sizeof(Path), gpu::BufferUse::storage),
      lanes(device, "lanes", mostLanes(slots) * sizeof(Lane), gpu::BufferUse::storage),
      waiting(device, "waiting paths", (putsPathsBy ? slots : 1) * sizeof(WaitingPath),
              gpu::BufferUse::storage),
      counters(device, "lane counters", sizeof(LaneCounters), gpu::BufferUse::readback) {}

gpu::ResourceTable FusedPaths::State::table() const {
    gpu::ResourceTable resources;
    resources.set("Paths", paths);
    resources.set("Lanes", lanes);
    resources.set("WaitingPaths", waiting);
    resources.set("LaneCounts", counters);
    return resources;
}

FusedPaths::FusedPaths(gpu::Device& device, const WaveInputs& inputs)
    : state_(device, inputs.frame.waveSize, (inputs.scene.features() & kFeatureManyTriangles) != 0),
      commands_(device) {
    bands_.reserve(inputs.film.bands().size());
    for (const FilmBand& band : inputs.film.bands())
        bands_.emplace_back(device, inputs, band, state_.table());
    commands_.begin();
    commands_.fill(state_.lanes, 0); // of no wave
    commands_.submitAndWait();
}

void FusedPaths::renderWave(size_t bandIndex, WaveRange range) {
    const BoundBand& band = bands_[bandIndex];
    const uint32_t slots = range.pixelCount * range.sampleCount;
    range.slotsPerLane = slotsPerLane(slots);
    range.wave = ++wave_;
    const uint32_t lanes = (slots + range.slotsPerLane - 1) / range.slotsPerLane;
    range.groupStride = strideThrough(groupsFor(lanes));
    while (advance(band, range, lanes) > 0) {
    }
    commands_.begin();
    commands_.dispatch(band["accumulate"], groupsFor(range.pixelCount), pushed(range));
    commands_.submitAndWait();
    rays_.camera += slots;
}

uint32_t FusedPaths::advance(const BoundBand& band, const WaveRange& range, uint32_t lanes) {
    commands_.begin();
    commands_.fill(state_.counters, 0);
    commands_.dispatch(band["path"], groupsFor(lanes), pushed(range));
    commands_.submitAndWait();
    const LaneCounters counters = state_.counters.downloadAll<LaneCounters>().front();
    rays_.indirect += counters.indirectRays;
    rays_.shadow += counters.shadowRays;
    return counters.unfinished;
}

} // namespace lavalight
