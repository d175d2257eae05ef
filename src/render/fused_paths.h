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

  private:
    struct State {
        State(gpu::Device& device, uint32_t slots, bool putsPathsBy);
        [[nodiscard]] gpu::ResourceTable table() const;
        gpu::Buffer paths, lanes, waiting, counters;
    };
    // The kernels bound to one band of the film.
    struct Band {
        Band(gpu::Device& device, const State& state, const WaveInputs& inputs, const FilmBand& film);
        BandResources resources;
        gpu::BoundKernel path, accumulate;
    };

    // Runs one dispatch and returns the number of lanes that want another.
    [[nodiscard]] uint32_t advance(const Band& band, const WaveRange& range, uint32_t lanes);

    State state_;
    std::vector<Band> bands_;
    uint32_t wave_ = 0; // the one under way
};

} // namespace lavalight
