// Waves rendered by one kernel that takes whole paths, from their beginnings to their ends, such as
// shaders/kernels/path.comp.
#pragma once

#include <vector>

#include "render/wave_renderer.h"

namespace lavalight {

class FusedPaths : public WaveRenderer {
  public:
    FusedPaths(gpu::Device& device, const WaveInputs& inputs);

    void renderWave(const Transport& transport, size_t band, WaveRange range) override;
    [[nodiscard]] const gpu::Buffer& slots(std::string_view block) const override { return state_[block]; }
    [[nodiscard]] gpu::KernelTimes kernelTimes() const override { return commands_.times(); }

  private:
    [[nodiscard]] gpu::ResourceTable table() const;
    // Runs one dispatch and returns the number of lanes that want another.
    [[nodiscard]] uint32_t advance(const gpu::BoundKernel& paths, const WaveRange& range, uint32_t lanes);

    SlotState state_;
    gpu::Buffer lanes_;
    gpu::Buffer counters_;
    std::vector<BoundBand> bands_;
    gpu::Commands commands_;
    uint32_t wave_ = 0; // the one under way
};

} // namespace lavalight
