// Renders from scene to files. It knows no command line: options arrive as values, progress and interruption
// are callbacks, failures are exceptions.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "film/sample_ranges.h"
#include "gltf/import_options.h"
#include "gpu/device.h"
#include "kernels/shader_overlay.h"
#include "render/settings.h"
#include "render/tone_mapper.h"
#include "session/camera_choice.h"
#include "session/outputs.h"
#include "session/render_job.h"

namespace lavalight {

// Inputs that all images of a session share.
struct RenderPlan {
    std::string scene;       // built-in name, or path of a file
    RenderSettings settings; // width 0: by the camera's aspect ratio
    CameraChoice camera;
    gpu::DeviceConfig device;
    OutputStyle style;
    // The scene with its light, if the caller has it already; null: the session loads it.
    std::shared_ptr<const Scene> loaded{};
};

// A scene that was loaded for a render, its camera, and settings that are complete and checked.
struct PreparedScene {
    Scene scene;
    Camera camera;
    RenderSettings settings;
};

// Loads the plan's scene at a moment of its animation, logs its warnings, and chooses the camera. Throws
// Error or UsageError naming the option.
[[nodiscard]] PreparedScene prepareScene(const RenderPlan& plan, const ImportOptions& moment);

// Keeps from one image to the next what can be kept: the device, kernels that serve, and the camera that
// stands in for a scene without one, so that an animation does not move it.
class RenderSession {
  public:
    // Opens no device yet.
    explicit RenderSession(RenderPlan plan) : plan_(std::move(plan)) {}
    // Renders on a device that is open already and outlives the session, whatever the plan says of devices.
    RenderSession(RenderPlan plan, gpu::Device& device) : plan_(std::move(plan)), device_(&device) {}
    RenderSession(const RenderSession&) = delete; // jobs refer to the device
    RenderSession& operator=(const RenderSession&) = delete;

    // Shaders for the jobs to come and for the record; null: those of the build.
    void use(const std::shared_ptr<ShaderOverlay>& overlay);
    // Turns of the plan's view for the jobs to come.
    void turn(float turns) { plan_.camera.turns = turns; }
    // Settings for the jobs to come, but for the record of shaders.
    void use(RenderSettings settings);
    // Another plan for the jobs to come, of the same device: whatever scenes left behind is forgotten.
    void use(RenderPlan plan);

    // What follows an image in a sequence, for its layer of motion.
    struct NextMoment {
        ImportOptions moment;
        std::optional<float> turns;            // of the plan's view
        std::shared_ptr<const Scene> loaded{}; // the scene at that moment; null: the session loads it
    };

    // Takes from the first scene of a sequence what its images share, where the session does not render it
    // itself: the camera that stands in, the ground's height, the size. `loaded`: the scene of the jobs to
    // come.
    void follow(const ImportOptions& first, std::shared_ptr<const Scene> loaded);

    // Loads the scene, opens the device if this is the first job, and compiles the kernels that `outputs`
    // need. Throws Error or UsageError.
    [[nodiscard]] RenderJob prepare(const ImportOptions& moment, const Outputs& outputs,
                                    const std::optional<NextMoment>& next = {});
    // Names of the kernels on which the job's images depend and whose code is another by `source`. Throws
    // Error as `source` does.
    [[nodiscard]] std::vector<std::string> changedKernels(const RenderJob& job,
                                                          const KernelSource& source) const;
    // Goes on with the shaders of use() and an empty film. Throws Error with the job as it was.
    void reload(RenderJob& job);

    // Goes on with other samples of the same image, and an empty film: the scene stays on the device.
    void restart(RenderJob& job, const SampleRange& samples);

    // Takes the job's samples, goes on from the checkpoint first if `resumes`, and keeps it up to date.
    void render(RenderJob& job, Checkpoint& checkpoint, bool resumes, const RenderJob::KeepGoing& keepGoing);
    // Writes the image so far. Throws Error, also for messages of the validation layer.
    void write(RenderJob& job, const Outputs& outputs);
    // The image so far, with its pixels where prepare() was told of a PNG. Throws Error as write() does.
    [[nodiscard]] FinishedImage image(RenderJob& job);
    // Ends a job; its kernels serve the next one.
    void finish(RenderJob job) { kernels_.emplace(job.renderer->releaseKernels()); }

  private:
    [[nodiscard]] PreparedScene load(const ImportOptions& moment);
    void loadNext(Scene& scene, const NextMoment& next) const;
    [[nodiscard]] Camera cameraOf(const Scene& scene, const CameraChoice& choice) const;
    [[nodiscard]] std::unique_ptr<Renderer> makeRenderer(const PreparedScene& prepared);
    void sayWhatTraces();

    RenderPlan plan_;
    KernelSource source_ = embeddedKernel;
    std::optional<Camera> standIn_;
    glm::dvec3 standInOrigin_{0.0};      // the origin of the scene that it is about
    std::optional<double> groundHeight_; // in the world
    bool isWarned_ = false;              // whether the warnings of a scene are told
    bool isToldWhatTraces_ = false;      // whether it is told why the schedule is not hosted
    std::optional<gpu::Device> ownDevice_;
    gpu::Device* device_ = nullptr; // null: not opened yet
    std::optional<EstimatorKernels> kernels_;
    std::optional<ToneMapper> toneMapper_;
};

} // namespace lavalight
