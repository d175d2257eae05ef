// Waves whose vertices kernels shade, a kernel for each class of materials, and whose rays the host traces.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hosted/record_tracer.h"
#include "render/wave_renderer.h"

namespace lavalight {

class HostedPaths : public WaveRenderer {
  public:
    // The host must be able to read the scene's buffers, and its accelerator must be on the host.
    HostedPaths(gpu::Device& device, const WaveInputs& inputs);

    void renderWave(const Transport& transport, size_t band, WaveRange range) override;
    [[nodiscard]] const gpu::Buffer& slots(std::string_view block) const override { return state_[block]; }
    [[nodiscard]] gpu::KernelTimes kernelTimes() const override;

  private:
    [[nodiscard]] gpu::ResourceTable table() const;
    void start(const Transport& transport, const BoundBand& band, WaveRange range);
    [[nodiscard]] RecordTracer::Regions trace(uint32_t records, uint32_t bounce);
    // Shades the records of each region; returns how many there are.
    uint32_t shade(const Transport& transport, const BoundBand& band, WaveRange range,
                   const RecordTracer::Regions& regions);

    FrameParameters frame_;
    std::vector<MaterialClass> classes_;
    SlotState state_;
    gpu::Buffer read_;    // by kernels
    gpu::Buffer written_; // by kernels
    RecordBuffers buffers_;
    RecordTracer tracer_;
    std::vector<BoundBand> bands_;
    gpu::Commands commands_;
    gpu::KernelTime hostTime_;
};

} // namespace lavalight
