#include "render/hosted_paths.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "hosted/record_planes.h"

namespace lavalight {
namespace {

// Fewer records than this are shaded within a few timestamps' time.
constexpr uint32_t kTimedRecords = 1u << 15;

gpu::Timing timingOf(uint32_t records) {
    return records < kTimedRecords ? gpu::Timing::together : gpu::Timing::eachKernel;
}

gpu::Buffer makeRecords(gpu::Device& device, const char* name, uint32_t planes, uint32_t waveSize,
                        gpu::BufferUse use) {
    return {device, name, uint64_t{planes} * planeStride(waveSize) * sizeof(glm::uvec4), use};
}

std::span<PathLayers> layersOf(const SlotState& state, const WaveInputs& inputs) {
    if (inputs.frame.hasLayers == 0)
        return {};
    return state["Layers"].mapped<PathLayers>();
}

} // namespace

HostedPaths::HostedPaths(gpu::Device& device, const WaveInputs& inputs)
    : frame_(inputs.frame), classes_(inputs.classes.list), state_(device, inputs),
      read_(
          makeRecords(device, "records to shade", kPlanesIn, inputs.frame.waveSize, gpu::BufferUse::texels)),
      written_(
          makeRecords(device, "shaded records", kPlanesOut, inputs.frame.waveSize, gpu::BufferUse::storage)),
      buffers_{written_.mapped<const glm::uvec4>(), read_.mapped<glm::uvec4>(),
               state_["Paths"].mapped<Path>(), layersOf(state_, inputs), planeStride(inputs.frame.waveSize)},
      tracer_(hostScene(inputs.scene, inputs.features), inputs.classes.ofMaterials,
              static_cast<uint32_t>(classes_.size()), inputs.frame.waveSize),
      commands_(device) {
    bands_ = bindBands(device, inputs, table());
}

gpu::ResourceTable HostedPaths::table() const {
    gpu::ResourceTable resources;
    state_.addTo(resources);
    resources.set("recordsIn", read_);
    resources.set("RecordsOut", written_);
    return resources;
}

void HostedPaths::renderWave(const Transport& transport, size_t bandIndex, WaveRange range) {
    const BoundBand& band = bands_[bandIndex];
    start(transport, band, range);
    uint32_t records = range.pixelCount * range.sampleCount;
    for (range.bounce = 0; records > 0; ++range.bounce) {
        const RecordTracer::Regions regions = trace(records, range.bounce);
        records = shade(transport, band, range, regions);
    }
    commands_.begin(timingOf(range.pixelCount));
    commands_.dispatch(band[transport.sink.kernel], groupsFor(transport.sink.over, range), pushed(range));
    commands_.submitAndWait();
}

// The rays of the records that kernels wrote after `bounce` vertices.
RecordTracer::Regions HostedPaths::trace(uint32_t records, uint32_t bounce) {
    const auto start = std::chrono::steady_clock::now();
    const RecordTracer::Regions regions = tracer_.advance(buffers_, records, bounce);
    hostTime_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++hostTime_.dispatches;
    raysPerBounce_.resize(std::max<size_t>(raysPerBounce_.size(), bounce + 1));
    raysPerBounce_[bounce] += tracer_.rays();
    (bounce == 0 ? rays_.camera : rays_.indirect) += tracer_.rays();
    rays_.shadow += tracer_.shadowRays();
    return regions;
}

gpu::KernelTimes HostedPaths::kernelTimes() const {
    gpu::KernelTimes times = commands_.times();
    times["rays on the host"] = hostTime_;
    return times;
}

void HostedPaths::start(const Transport& transport, const BoundBand& band, WaveRange range) {
    range.firstRecord = 0;
    range.recordCount = range.pixelCount * range.sampleCount;
    commands_.begin(timingOf(range.recordCount));
    commands_.dispatch(band[transport.hosted.camera], groupsFor(range.recordCount), pushed(range));
    commands_.submitAndWait();
    tracer_.start(frame_, range);
}

uint32_t HostedPaths::shade(const Transport& transport, const BoundBand& band, WaveRange range,
                            const RecordTracer::Regions& regions) {
    const uint32_t records = std::accumulate(regions.begin(), regions.end(), 0u);
    if (records == 0)
        return 0;
    commands_.begin(timingOf(records));
    range.firstRecord = 0;
    for (size_t i = 0; i <= classes_.size(); ++i) {
        range.recordCount = regions[i];
        const std::string kernel = i < classes_.size() ? variantName(transport.hosted.scatter, classes_[i])
                                                       : std::string(transport.hosted.escape);
        if (range.recordCount > 0)
            commands_.dispatch(band[kernel], groupsFor(range.recordCount), pushed(range));
        range.firstRecord += range.recordCount;
    }
    commands_.submitAndWait();
    return records;
}

} // namespace lavalight
