// The wavefront: a wave of path slots taken bounce by bounce through the kernels of the estimator.
#pragma once

#include <cstdint>
#include <vector>

#include "render/wave_renderer.h"

namespace lavalight {

class Wavefront : public WaveRenderer {
  public:
    Wavefront(gpu::Device& device, const WaveInputs& inputs);

    void renderWave(size_t band, WaveRange range) override;

  private:
    // One element per slot, but for queues (three of them) and the few words at the end.
    struct State {
        State(gpu::Device& device, uint32_t slots, uint32_t maxBounces);
        [[nodiscard]] gpu::ResourceTable table() const;
        gpu::Buffer rays, hits, paths, shadowRays, queues, counters, dispatchSizes;
    };
    // The kernels bound to one band of the film.
    struct Band {
        Band(gpu::Device& device, const State& state, const WaveInputs& inputs, const FilmBand& film);
        BandResources resources;
        gpu::BoundKernel generate, extend, shade, prepare, connect, accumulate;
    };

    void recordBounce(const Band& band, WaveRange range, uint32_t bounce);
    void countRays();

    uint32_t maxBounces_;
    State state_;
    std::vector<Band> bands_;
};

} // namespace lavalight
