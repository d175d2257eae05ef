// A render from a scene to its film: the public face of render/.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device_scene/gpu_scene.h"
#include "device_scene/triangle_layers.h"
#include "film/stop_reason.h"
#include "gpu/commands.h"
#include "gpu/device.h"
#include "image/rendering.h"
#include "render/estimator_kernels.h"
#include "render/film.h"
#include "render/frame.h"
#include "render/settings.h"
#include "render/wave_renderer.h"
#include "render/wave_walk.h"
#include "scene/scene.h"

namespace lavalight {

class Renderer {
  public:
    // Uploads the scene and builds the kernels. The settings must be checked, their width resolved
    // (resolveSize). The device must outlive the renderer. Throws Error where the device's limits are
    // exceeded. The default kernels are those that the build embedded.
    Renderer(gpu::Device& device, const Scene& scene, const Camera& camera, const RenderSettings& settings,
             const KernelSource& source = embeddedKernel);
    // Takes over the kernels of an earlier renderer of that device, if they serve; else builds new ones. Both
    // renderers have one source.
    Renderer(gpu::Device& device, const Scene& scene, const Camera& camera, const RenderSettings& settings,
             EstimatorKernels earlier, const KernelSource& source = embeddedKernel);
    Renderer(const Renderer&) = delete; // the wavefront refers to the scene and the film
    Renderer& operator=(const Renderer&) = delete;

    // Asked between waves with the fraction done so far, in [0, 1]; false ends the render early.
    using KeepGoing = std::function<bool(double fraction)>;

    // Takes samples until the settings or `keepGoing` say stop. The film is valid after an early end too:
    // each pixel knows how many samples it has.
    StopReason render(const KeepGoing& keepGoing);

    // Takes one step of render(): the samples of one wave, of at most `mostSlots` paths but at least one
    // pixel's.
    void step(uint32_t mostSlots);
    // Whether all samples are taken.
    [[nodiscard]] bool isDone() const { return walk_.isDone(); }
    [[nodiscard]] const RenderPosition& position() const { return walk_.position(); }
    // progress() is the position whatever the bands; continueFrom() returns to it with the film that belongs
    // to it, and what follows has the bits that it would have had. The pass must not take more samples at
    // once than there are slots.
    [[nodiscard]] FilmProgress progress() const { return walk_.progress(); }
    void continueFrom(const FilmProgress& progress, const RawFilm& film);

    // Goes on with another view, settings or kernels, and an empty film. The scene stays on the device;
    // kernels are compiled where `source` has other code or those there are do not serve. `scene` is still
    // the same, and so are its lights (keepsLights) and its accelerator. Throws Error with everything as it
    // was, though the image may have to start from its first sample. Until it is done, two states of a wave
    // take memory.
    void restart(const Scene& scene, const Camera& camera, const RenderSettings& wanted,
                 const KernelSource& source);

    // Whether restart() and reloadKernels() can serve these: a schedule with another accelerator needs the
    // scene anew. Throws Error as `source` does.
    [[nodiscard]] bool keepsAccelerator(const RenderSettings& wanted, const KernelSource& source) const;

    // Names of the kernels whose code is another by `source`. Throws
    // Error where one does not compile. May be asked while it renders.
    [[nodiscard]] std::vector<std::string> changedKernels(const KernelSource& source) const;
    // Goes on with the kernels of changedKernels(), and an empty film. Throws Error as restart() does.
    void reloadKernels(const KernelSource& source);

    // Waits for the waves that are under way, as waves() does: where a device gains from it, a wave is
    // submitted before the one ahead of it is done.
    [[nodiscard]] const Film& film() const {
        waves_->finish();
        return film_;
    }
    [[nodiscard]] Rendering rendering() const { return film().resolve(); }
    [[nodiscard]] const GpuScene& scene() const { return scene_; }
    [[nodiscard]] const WaveRenderer& waves() const {
        waves_->finish();
        return *waves_;
    }
    // The parameters of all bands; bandPixels is left open.
    [[nodiscard]] const FrameParameters& frame() const { return frame_; }
    // kFeature... bits of the scene and the camera.
    [[nodiscard]] SceneFeatures features() const { return features_; }
    [[nodiscard]] const EstimatorKernels& kernels() const { return kernels_; }
    // Hands on the kernels; no sample may be taken any more.
    [[nodiscard]] EstimatorKernels releaseKernels() {
        waves_->finish();
        return std::move(kernels_).handOn();
    }
    // The settings, with everything resolved that was left to the device.
    [[nodiscard]] const RenderSettings& settings() const { return settings_; }

  private:
    struct Fresh;
    [[nodiscard]] bool wantsAlbedoTable(const KernelSource& source) const;
    void compileChanged(Fresh& fresh, const KernelSource& source) const;
    [[nodiscard]] std::unique_ptr<WaveRenderer> makeWaves(const Fresh& fresh) const;
    void startAnew(Fresh fresh);
    void emptyFilm();
    // Adds what the samples of a wave met to the film's ids.
    void countIds(const WaveRange& range);

    struct Setup;
    Renderer(gpu::Device& device, const RenderSettings& settings,
             const std::function<Setup(const RenderSettings&)>& setUp, const KernelSource& source);
    Renderer(gpu::Device& device, const RenderSettings& settings, Setup setup, const KernelSource& source);

    gpu::Device* device_;
    RenderSettings settings_;
    FrameParameters frame_;
    SceneFeatures sceneFeatures_; // kFeature..., without the camera's
    SceneFeatures features_;      // with them
    MaterialClasses classes_;
    EstimatorKernels kernels_;
    GpuScene scene_;
    Film film_;
    gpu::Buffer triangleLayers_; // a TriangleLayers for each triangle, or none
    SurfaceIds surfaceIds_;      // none where no ids are counted
    WaveWalk walk_;
    std::unique_ptr<WaveRenderer> waves_;
    bool filmIsEmptied_ = true; // false: emptying it failed, and has to be done before the first sample
};

// The error that --target-error limits: mean(Var / (mean^2 + 0.01)) over pixels and channels, Var being the
// variance of a pixel's mean. It estimates relMSE for independent samples; Sobol's are correlated, and for
// them it is an upper bound.
[[nodiscard]] double errorEstimate(const Rendering& rendering);

// Width from the camera's aspect ratio where the settings leave it open (16:9 where the camera does too).
[[nodiscard]] RenderSettings resolveSize(RenderSettings settings, const Camera& camera);

// Whether a renderer of settings `a` may restart() with `b`, as far as the lights are concerned.
[[nodiscard]] bool keepsLights(const RenderSettings& a, const RenderSettings& b);

} // namespace lavalight
