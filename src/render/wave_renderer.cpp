#include "render/wave_renderer.h"

#include <cassert>
#include <utility>

#include "render/fused_paths.h"
#include "render/wavefront.h"

namespace lavalight {
namespace {

gpu::Buffer uploadFrame(gpu::Device& device, FrameParameters parameters, const FilmBand& band) {
    parameters.bandPixels = band.rows * parameters.imageWidth;
    gpu::Buffer buffer(device, "frame parameters", sizeof(FrameParameters), gpu::BufferUse::uniform);
    buffer.upload(std::span<const FrameParameters>(&parameters, 1));
    return buffer;
}

} // namespace

std::unique_ptr<WaveRenderer> makeWaveRenderer(gpu::Device& device, Schedule schedule,
                                               const WaveInputs& inputs) {
    assert(schedule != Schedule::automatic);
    if (schedule == Schedule::fused)
        return std::make_unique<FusedPaths>(device, inputs);
    return std::make_unique<Wavefront>(device, inputs);
}

BoundBand::BoundBand(gpu::Device& device, const WaveInputs& inputs, const FilmBand& band,
                     gpu::ResourceTable resources)
    : frame_(uploadFrame(device, inputs.frame, band)) {
    inputs.scene.addTo(resources);
    resources.set("albedoTable", inputs.albedoTable);
    resources.set("Tallies", inputs.film.tallies());
    resources.set("Frame", frame_);
    resources.set("Film", band.sums);
    for (const std::string_view name : inputs.kernelNames)
        kernels_.try_emplace(name, device, inputs.kernel(name), resources);
}

const gpu::BoundKernel& BoundBand::operator[](std::string_view name) const {
    const auto found = kernels_.find(name);
    assert(found != kernels_.end());
    return found->second;
}

uint32_t groupsFor(uint32_t invocations) {
    return (invocations + kWorkgroupSize - 1) / kWorkgroupSize;
}

std::span<const std::byte> pushed(const WaveRange& range) {
    return std::as_bytes(std::span(&range, 1));
}

} // namespace lavalight
