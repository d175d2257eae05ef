// The wavefront: a wave of path slots taken bounce by bounce through the kernels of the estimator.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "render/film.h"
#include "render/gpu_scene.h"
#include "render/settings.h"
#include "shared/wavefront.h"

namespace lavalight {

// Rays traced so far.
struct RayCounts {
    uint64_t camera = 0;
    uint64_t indirect = 0;
    uint64_t shadow = 0;
    [[nodiscard]] uint64_t total() const { return camera + indirect + shadow; }
};

// Where compiled kernels come from, by name.
using KernelSource = std::function<gpu::KernelCode(std::string_view name)>;

// Those that the build compiled.
[[nodiscard]] gpu::KernelCode embeddedKernel(std::string_view name);

// The kernels of a wave, specialised to an estimator.
struct WavefrontKernels {
    WavefrontKernels(const gpu::Device& device, const EstimatorSettings& settings,
                     const KernelSource& source);
    gpu::Kernel generate, extend, shade, prepare, connect, accumulate;
};

class Wavefront {
  public:
    // `frame` says what scene, camera and settings decide; the band's size is filled in here. The device, the
    // scene and the film must outlive the wavefront.
    Wavefront(gpu::Device& device, WavefrontKernels kernels, const GpuScene& scene, const Film& film,
              const FrameParameters& frame);

    // Takes range.sampleCount samples for each of range.pixelCount pixels of band `band` and adds them to the
    // film. pixelCount * sampleCount must not exceed the wave size.
    void renderWave(size_t band, const WaveRange& range);

    [[nodiscard]] const RayCounts& rays() const { return rays_; }
    [[nodiscard]] const gpu::KernelTimes& kernelTimes() const { return commands_.times(); }

  private:
    // One element per slot, but for queues (three of them) and the few words at the end.
    struct State {
        State(gpu::Device& device, uint32_t slots, uint32_t maxBounces);
        void addTo(gpu::ResourceTable& resources) const;
        gpu::Buffer rays, hits, paths, shadowRays, queues, counters, dispatchSizes;
    };
    // The kernels bound to one band of the film.
    struct Band {
        Band(gpu::Device& device, const WavefrontKernels& kernels, const gpu::ResourceTable& shared,
             const FilmBand& film, const FrameParameters& parameters);
        gpu::Buffer frame;
        gpu::ResourceTable resources;
        gpu::BoundKernel generate, extend, shade, prepare, connect, accumulate;
    };

    void recordBounce(const Band& band, WaveRange range, uint32_t bounce);
    void countRays();

    uint32_t maxBounces_;
    WavefrontKernels kernels_;
    State state_;
    std::vector<Band> bands_;
    gpu::Commands commands_;
    RayCounts rays_;
};

} // namespace lavalight
