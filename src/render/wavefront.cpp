#include "render/wavefront.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <utility>

#include "kernels.h"

namespace lavalight {
namespace {

uint32_t groupsFor(uint32_t invocations) {
    return (invocations + kWorkgroupSize - 1) / kWorkgroupSize;
}

std::span<const std::byte> pushed(const WaveRange& range) {
    return std::as_bytes(std::span(&range, 1));
}

// For lib/estimator.glsl. Kernels ignore constants that they do not declare.
std::array<gpu::SpecialisationConstant, 7> constantsOf(const EstimatorSettings& settings) {
    return {{{CONSTANT_SAMPLER, static_cast<uint32_t>(settings.sampler)},
             {CONSTANT_HEMISPHERE, static_cast<uint32_t>(settings.hemisphere)},
             {CONSTANT_NEE, settings.nextEventEstimation ? 1u : 0u},
             {CONSTANT_MIS, static_cast<uint32_t>(settings.mis)},
             {CONSTANT_ROULETTE, static_cast<uint32_t>(settings.roulette)},
             {CONSTANT_MIS_SURVIVAL, settings.misSurvival ? 1u : 0u},
             {CONSTANT_FRESNEL, static_cast<uint32_t>(settings.fresnel)}}};
}

} // namespace

gpu::KernelCode embeddedKernel(std::string_view name) {
    return kernels::find(name);
}

WavefrontKernels::WavefrontKernels(const gpu::Device& device, const EstimatorSettings& settings,
                                   const KernelSource& source)
    : generate(device, source("generate"), constantsOf(settings)), extend(device, source("extend")),
      shade(device, source("shade"), constantsOf(settings)), prepare(device, source("prepare")),
      connect(device, source("connect")), accumulate(device, source("accumulate")) {}

Wavefront::State::State(gpu::Device& device, uint32_t slots, uint32_t maxBounces)
    : rays(device, "rays", slots * sizeof(Ray), gpu::BufferUse::storage),
      hits(device, "hits", slots * sizeof(Hit), gpu::BufferUse::storage),
      paths(device, "paths", slots * sizeof(Path), gpu::BufferUse::storage),
      shadowRays(device, "shadow rays", slots * sizeof(ShadowRay), gpu::BufferUse::storage),
      queues(device, "queues", 3 * slots * sizeof(uint32_t), gpu::BufferUse::storage),
      counters(device, "bounce counters", (maxBounces + 2) * sizeof(BounceCounters), gpu::BufferUse::readback),
      dispatchSizes(device, "dispatch sizes", 2 * sizeof(DispatchSize), gpu::BufferUse::storage) {}

void Wavefront::State::addTo(gpu::ResourceTable& resources) const {
    resources.set("Rays", rays);
    resources.set("Hits", hits);
    resources.set("Paths", paths);
    resources.set("ShadowRays", shadowRays);
    resources.set("Queues", queues);
    resources.set("Counters", counters);
    resources.set("DispatchSizes", dispatchSizes);
}

namespace {

gpu::Buffer uploadFrame(gpu::Device& device, FrameParameters parameters, const FilmBand& film) {
    parameters.bandPixels = film.rows * parameters.imageWidth;
    gpu::Buffer buffer(device, "frame parameters", sizeof(FrameParameters), gpu::BufferUse::storage);
    buffer.upload(std::span<const FrameParameters>(&parameters, 1));
    return buffer;
}

gpu::ResourceTable withBand(gpu::ResourceTable resources, const gpu::Buffer& frame, const FilmBand& film) {
    resources.set("Frame", frame);
    resources.set("Film", film.sums);
    return resources;
}

} // namespace

Wavefront::Band::Band(gpu::Device& device, const WavefrontKernels& kernels, const gpu::ResourceTable& shared,
                      const FilmBand& film, const FrameParameters& parameters)
    : frame(uploadFrame(device, parameters, film)), resources(withBand(shared, frame, film)),
      generate(device, kernels.generate, resources), extend(device, kernels.extend, resources), shade(device, kernels.shade, resources),
      prepare(device, kernels.prepare, resources), connect(device, kernels.connect, resources),
      accumulate(device, kernels.accumulate, resources) {}

Wavefront::Wavefront(gpu::Device& device, WavefrontKernels kernels, const GpuScene& scene, const Film& film,
                     const FrameParameters& frame)
    : maxBounces_(frame.maxBounces), kernels_(std::move(kernels)),
      state_(device, frame.waveSize, maxBounces_), commands_(device) {
    gpu::ResourceTable resources;
    scene.addTo(resources);
    state_.addTo(resources);
    resources.set("Tallies", film.tallies());
    bands_.reserve(film.bands().size());
    for (const FilmBand& band : film.bands())
        bands_.emplace_back(device, kernels_, resources, band, frame);
}

void Wavefront::renderWave(size_t bandIndex, const WaveRange& range) {
    const Band& band = bands_[bandIndex];
    const uint32_t slots = range.pixelCount * range.sampleCount;
    commands_.begin();
    commands_.fill(state_.counters, 0);
    commands_.dispatch(band.generate, groupsFor(slots), pushed(range));
    for (uint32_t bounce = 0; bounce <= maxBounces_; ++bounce)
        recordBounce(band, range, bounce);
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
    rays_.camera += counters.front().rays;
    for (size_t bounce = 0; bounce < counters.size(); ++bounce) {
        rays_.indirect += bounce > 0 ? counters[bounce].rays : 0;
        rays_.shadow += counters[bounce].shadowRays;
    }
}

} // namespace lavalight
