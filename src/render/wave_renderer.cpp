#include "render/wave_renderer.h"

#include <cassert>
#include <string>
#include <utility>

#include "render/fused_paths.h"
#include "render/hosted_paths.h"
#include "render/wavefront.h"

namespace lavalight {
namespace {

gpu::Buffer uploadFrame(gpu::Device& device, FrameParameters parameters, const FilmBand& band) {
    parameters.bandPixels = band.rows * parameters.cropWidth;
    gpu::Buffer buffer(device, "frame parameters", sizeof(FrameParameters), gpu::BufferUse::uniform);
    buffer.upload(std::span<const FrameParameters>(&parameters, 1));
    return buffer;
}

} // namespace

std::unique_ptr<WaveRenderer> makeWaveRenderer(gpu::Device& device, const WaveInputs& inputs) {
    assert(inputs.schedule != Schedule::automatic);
    if (inputs.schedule == Schedule::fused)
        return std::make_unique<FusedPaths>(device, inputs);
    if (inputs.schedule == Schedule::hosted)
        return std::make_unique<HostedPaths>(device, inputs);
    return std::make_unique<Wavefront>(device, inputs);
}

SlotState::SlotState(gpu::Device& device, const WaveInputs& inputs) {
    const SceneFeatures features = inputs.features;
    for (const Phase& phase : inputs.phases)
        for (const SlotBuffer& wanted : stateOf(*phase.transport, inputs.schedule)) {
            const bool isUsed = wanted.onlyWith == 0 || (wanted.onlyWith & features) != 0;
            const uint64_t slots = isUsed ? inputs.frame.waveSize : 1;
            if (!buffers_.contains(wanted.block))
                buffers_.try_emplace(wanted.block, device, std::string(wanted.label), slots * wanted.bytes,
                                     gpu::BufferUse::storage);
        }
}

void SlotState::addTo(gpu::ResourceTable& resources) const {
    for (const auto& [block, buffer] : buffers_)
        resources.set(block, buffer);
}

const gpu::Buffer& SlotState::operator[](std::string_view block) const {
    const auto found = buffers_.find(block);
    assert(found != buffers_.end());
    return found->second;
}

BoundBand::BoundBand(gpu::Device& device, const WaveInputs& inputs, const FilmBand& band,
                     gpu::ResourceTable resources)
    : frame_(uploadFrame(device, inputs.frame, band)) {
    inputs.scene.addTo(resources);
    resources.set("albedoTable", inputs.albedoTable);
    resources.set("Triangles", inputs.triangleLayers);
    resources.set("Tallies", inputs.film.tallies());
    resources.set("Frame", frame_);
    resources.set("Film", band.sums);
    for (const KernelVariant& variant : kernelVariants(inputs.phases, inputs.schedule, inputs.classes))
        kernels_.try_emplace(variant.name, device, inputs.kernel(variant.name), resources);
}

const gpu::BoundKernel& BoundBand::operator[](std::string_view name) const {
    const auto found = kernels_.find(name);
    assert(found != kernels_.end());
    return found->second;
}

std::vector<BoundBand> bindBands(gpu::Device& device, const WaveInputs& inputs,
                                 const gpu::ResourceTable& state) {
    std::vector<BoundBand> bands;
    bands.reserve(inputs.film.bands().size());
    for (const FilmBand& band : inputs.film.bands())
        bands.emplace_back(device, inputs, band, state);
    return bands;
}

uint32_t groupsFor(uint32_t invocations) {
    return (invocations + kWorkgroupSize - 1) / kWorkgroupSize;
}

uint32_t groupsFor(Over over, const WaveRange& range) {
    if (over == Over::once)
        return 1;
    if (over == Over::pixels)
        return groupsFor(range.pixelCount);
    return groupsFor(range.pixelCount * range.sampleCount); // a slot has at most one ray of each kind
}

std::span<const std::byte> pushed(const WaveRange& range) {
    return std::as_bytes(std::span(&range, 1));
}

} // namespace lavalight
