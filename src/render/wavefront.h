// The wavefront: a wave of path slots taken bounce by bounce through the kernels of its transport.
#pragma once

#include <cstdint>
#include <vector>

#include "render/wave_renderer.h"

namespace lavalight {

class Wavefront : public WaveRenderer {
  public:
    Wavefront(gpu::Device& device, const WaveInputs& inputs);

    void renderWave(const Transport& transport, size_t band, WaveRange range) override;
    [[nodiscard]] const gpu::Buffer& slots(std::string_view block) const override { return state_[block]; }
    void finish() override;
    [[nodiscard]] gpu::KernelTimes kernelTimes() const override;

  private:
    // One of the two waves that may be under way. They share their state, since the device takes one after
    // the other, but the host looks at the counters of the first while the second counts.
    struct Turn {
        Turn(gpu::Device& device, uint32_t maxBounces);
        gpu::Buffer counters;
        bool isCounted = true; // countRays() has counted it; false: a wave has filled it since
    };
    [[nodiscard]] gpu::ResourceTable tableOf(const Turn& turn) const;
    gpu::Commands& startRecording();
    void submit(gpu::Commands& commands) const;
    [[nodiscard]] bool isOver(const Turn& turn, uint32_t bounce) const;
    void record(gpu::Commands& commands, const BoundBand& band, const KernelStep& step,
                const WaveRange& range) const;
    void countRays(Turn& turn);

    uint32_t maxBounces_;
    bool runsAhead_;
    SlotState state_;
    gpu::Buffer queues_; // three
    gpu::Buffer dispatchSizes_;
    std::vector<Turn> turns_;                   // two
    std::vector<std::vector<BoundBand>> bands_; // bands of each turn
    std::vector<gpu::Commands> commands_;       // two, in turn; they end, waiting, before what they use does
    size_t turn_ = 0;                           // turn of the newest wave
    size_t recording_ = 0;                      // index in commands_ of the newest
};

} // namespace lavalight
