// Waves rendered by one kernel that takes whole paths, from the camera to their ends:
// shaders/kernels/path.comp.
#pragma once

#include <vector>

#include "render/wave_renderer.h"

namespace lavalight {

class FusedPaths : public WaveRenderer {
  public:
    FusedPaths(gpu::Device& device, const WaveInputs& inputs);

    void renderWave(size_t band, WaveRange range) override;
    [[nodiscard]] gpu::KernelTimes kernelTimes() const override { return commands_.times(); }

  private:
    struct State {
        State(gpu::Device& device, uint32_t slots, bool putsPathsBy);
        [[nodiscard]] gpu::ResourceTable table() const;
        gpu::Buffer paths, lanes, waiting, counters;
    };
    // Runs one dispatch and returns the number of lanes that want another.
    [[nodiscard]] uint32_t advance(const BoundBand& band, const WaveRange& range, uint32_t lanes);

    State state_;
    std::vector<BoundBand> bands_;
    gpu::Commands commands_;
    uint32_t wave_ = 0; // the one under way
};

} // namespace lavalight
