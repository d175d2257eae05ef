// Renderers of waves of paths: the interface of those that there are, render/wavefront.h,
// render/fused_paths.h and render/hosted_paths.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "device_scene/gpu_scene.h"
#include "film/film_cost.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "render/estimator_kernels.h"
#include "render/film.h"
#include "render/phase.h"
#include "shared/frame.h"
#include "shared/wavefront.h"

namespace lavalight {

class WaveRenderer {
  public:
    virtual ~WaveRenderer() = default;
    WaveRenderer(const WaveRenderer&) = delete; // bound kernels refer to members
    WaveRenderer& operator=(const WaveRenderer&) = delete;

    // Takes range.sampleCount samples by `transport` for each of range.pixelCount pixels of band `band` and
    // adds them to the film, at the latest by finish(). pixelCount * sampleCount must not exceed the wave
    // size, and one of the phases must have the transport.
    virtual void renderWave(const Transport& transport, size_t band, WaveRange range) = 0;

    // Waits for waves that are still under way: until then, neither the film nor what follows is that of all
    // waves.
    virtual void finish() {}

    // The buffer of a block of the transports' state, after finish().
    [[nodiscard]] virtual const gpu::Buffer& slots(std::string_view block) const = 0;

    [[nodiscard]] const RayCounts& rays() const { return rays_; }
    // Camera rays, then those to the next vertex, by bounce: the lengths of the queues. Empty where there are
    // no queues.
    [[nodiscard]] const std::vector<uint64_t>& raysPerBounce() const { return raysPerBounce_; }
    // Device time of all waves, none on a queue without timestamps; and the host's, where it traces.
    [[nodiscard]] virtual gpu::KernelTimes kernelTimes() const = 0;

  protected:
    WaveRenderer() = default;

    RayCounts rays_;
    std::vector<uint64_t> raysPerBounce_;
};

// Inputs that decide how waves are rendered. Kernels, and the buffers of scene, table and film, must outlive
// the renderer; `frame` says what scene, camera and settings decide (the size of a band is filled in). The
// schedule must not be automatic.
struct WaveInputs {
    std::span<const Phase> phases;
    Schedule schedule;
    const GpuScene& scene;
    const gpu::Buffer& albedoTable;    // the scene's or another
    const gpu::Buffer& triangleLayers; // a TriangleLayers for each triangle, where layers ask for them
    const Film& film;
    const FrameParameters& frame;
    std::function<const gpu::Kernel&(std::string_view name)> kernel; // by the names of kernelVariants()
    // For Schedule::hosted: the scene's classes of materials, and its features with the camera's.
    const MaterialClasses& classes;
    SceneFeatures features;
};

// The device must outlive the renderer.
[[nodiscard]] std::unique_ptr<WaveRenderer> makeWaveRenderer(gpu::Device& device, const WaveInputs& inputs);

// The state of the transports: buffers with a record for each path slot.
class SlotState {
  public:
    SlotState(gpu::Device& device, const WaveInputs& inputs);

    void addTo(gpu::ResourceTable& resources) const;
    // The buffer of a block, which one of the transports must have.
    [[nodiscard]] const gpu::Buffer& operator[](std::string_view block) const;

  private:
    std::map<std::string_view, gpu::Buffer> buffers_; // by block
};

// The kernels of the phases, bound to one band of the film.
class BoundBand {
  public:
    // `state`: the buffers that all bands share.
    BoundBand(gpu::Device& device, const WaveInputs& inputs, const FilmBand& band, gpu::ResourceTable state);

    // The kernel must be one of the phases'.
    [[nodiscard]] const gpu::BoundKernel& operator[](std::string_view name) const;

  private:
    gpu::Buffer frame_;
    std::map<std::string, gpu::BoundKernel, std::less<>> kernels_;
};

// The kernels bound to each band of the film. `state`: the buffers that all bands share.
[[nodiscard]] std::vector<BoundBand> bindBands(gpu::Device& device, const WaveInputs& inputs,
                                               const gpu::ResourceTable& state);

[[nodiscard]] uint32_t groupsFor(uint32_t invocations);
// Workgroups for the most invocations that a kernel can have in a wave.
[[nodiscard]] uint32_t groupsFor(Over over, const WaveRange& range);
[[nodiscard]] std::span<const std::byte> pushed(const WaveRange& range);

} // namespace lavalight
