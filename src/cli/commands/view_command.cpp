#include "cli/commands/view_command.h"

#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/os/memory.h"
#include "gpu/vulkan_error.h"
#include "view/viewer.h"

namespace lavalight {
namespace {

// Slots of a wave: one takes some 40 ms on lavapipe, and makes an image that is looked at wait no longer.
constexpr uint32_t kWaveSize = 1u << 16;

} // namespace

// Without --spp, until the window is closed.
RenderPlan ViewCommand::plan() {
    RenderPlan plan = options_.plan(scene_);
    RenderSettings& settings = plan.settings;
    settings.background = background_.settings();
    settings.ground = ground_.settings();
    if (settings.stop.seconds > 0.0 || settings.stop.targetError > 0.0)
        throw UsageError("--time and --target-error: a window renders until it is closed, or to --spp");
    if (parser().count("--spp") == 0)
        settings.stop.samples = std::numeric_limits<int32_t>::max();
    if (settings.work.waveSize == 0)
        settings.work.waveSize = kWaveSize;
    return plan;
}

int ViewCommand::run() {
    keepHeapSmall();
    const RenderPlan plan = this->plan();
    if (!isNotWatching_)
        shaders_.watchIfThere();
    const std::shared_ptr<ShaderOverlay> overlay = shaders_.overlay();
    const ImportOptions import = seenFrom(plan.camera, sceneOptions_.importOptions());
    PreparedScene prepared = prepareScene(plan, import);
    const auto scene = std::make_shared<const Scene>(std::move(prepared.scene));
    const RenderSettings& settings = prepared.settings;
    ViewState view{scene_,          import,
                   scene,           CameraRig(prepared.camera, scene->bounds),
                   prepared.camera, settings.provenance.cameraOptions,
                   settings,        tone_.settings()};
    view.exposesByImage = tone_.isAutomatic();
    view.tone.backdrop = background_.backdrop();
    if (const std::optional<glm::vec3> color = background_.color())
        view.backdrop = *color;
    if (const std::optional<DenoiseQuality> quality = denoise_.quality()) {
        view.shown.fill(kDenoisedColor);
        view.quality = *quality;
    }
    ViewerConfig config{std::move(view), plan.device, overlay,
                        shaders_.isWatching() ? shaders_.folder() : std::string()};
    gpu::checked("draw", "the window", [&] { Viewer(std::move(config)).run(); });
    return 0;
}

} // namespace lavalight
