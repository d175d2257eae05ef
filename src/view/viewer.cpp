#include "view/viewer.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include "base/log.h"
#include "image/environment_file.h"
#include "render/phase.h"
#include "render/renderer.h"
#include "render/schedule_choice.h"
#include "session/lit_scene.h"
#include "view/controls.h"
#include "view/inspector_panel.h"
#include "view/light_choice.h"
#include "view/panel.h"

namespace lavalight {
namespace {

using Clock = std::chrono::steady_clock;

// Frames after input until ImGui has drawn its last consequence: a button is released in the frame after the
// press, and only the next one knows.
constexpr int kFramesToSettle = 3;

// A camera that has been still for so long is looked through at full resolution.
constexpr std::chrono::milliseconds kStillAfter(200);

Window makeWindow(const ViewState& view) {
    return {fmt::format("Lavalight: {}", view.source),
            {view.settings.image.width, view.settings.image.height}};
}

// The first of NAME-1, NAME-2, ... of which no image is there.
std::string freeName(const std::string& source) {
    const std::string stem = std::filesystem::path(source).stem().string();
    for (int number = 1;; ++number) {
        std::string name = fmt::format("{}-{}", stem, number);
        if (!std::filesystem::exists(name + ".exr") && !std::filesystem::exists(name + ".png"))
            return name;
    }
}

Scene loadOrder(const SceneOrder& order) {
    Scene scene = loadLitScene(order.source, order.import, order.lighting);
    layGround(order.ground, order.groundHeight.value_or(groundHeightOf(scene)), scene);
    return scene;
}

} // namespace

Viewer::Viewer(ViewerConfig config)
    : view_(std::move(config.view)), window_(makeWindow(view_)), presenter_(window_, config.device.validate),
      render_(config.device, &Window::wake), loader_(loadOrder, &Window::wake),
      shaders_(std::move(config.shaders)) {
    const RayAccelerator accelerator = view_.settings.work.accelerator;
    view_.settings = resolveSchedule(view_.settings, render_.device());
    view_.settings.work.accelerator = accelerator; // follows the schedule that the panel chooses
    view_.light = view_.settings.lighting;
    view_.ground = view_.settings.ground;
    if (!config.watched.empty())
        watcher_.emplace(config.watched, shaders_, watchedKernels(view_.settings), &Window::wake);
    view_.canBeHosted = render_.device().sharesMemory;
    sayWhatTraces();
    ImGui::GetIO().FontGlobalScale = window_.textScale() / window_.pixelsPerPoint().y;
}

std::vector<std::string> Viewer::watchedKernels(const RenderSettings& settings) const {
    return decisiveKernels(resolveSchedule(settings, render_.device()));
}

void Viewer::run() {
    while (!window_.isClosing()) {
        window_.wait(patience());
        unsettled_ = window_.takeInput() ? kFramesToSettle : std::max(0, unsettled_ - 1);
        receive();
        presenter_.beginFrame();
        takeKeys();
        takeDrops();
        move();
        draw();
        send(); // before the frame is drawn, which takes processors, too
        presenter_.endFrame(view_.isSplit ? view_.splitAt : 1.0f);
        updateTitle();
        presenter_.requireNoValidationMessages();
    }
}

// Seconds until the window is drawn again, whatever happens.
double Viewer::patience() const {
    if (view_.isFlying || unsettled_ > 0)
        return 0.016;
    return Clock::now() - lastMove_ < 2 * kStillAfter ? 0.05 : 0.5;
}

glm::vec2 Viewer::points() const {
    return glm::vec2(window_.pixels()) / window_.pixelsPerPoint();
}

void Viewer::tell(const std::string& text, bool isError) {
    if (isError)
        spdlog::error("{}", text);
    else
        spdlog::info("{}", text);
    messages_.emplace_back(text, isError);
}

void Viewer::sayWhatTraces() {
    const std::string why = whyNotHosted(view_.settings, render_.device(), sourceOf(shaders_));
    if (!why.empty())
        tell(why, false);
}

void Viewer::receive() {
    receiveScene();
    receiveShaders();
    LiveNews news = render_.news();
    isReady_ = news.isReady;
    isFinished_ = news.isFinished;
    if (news.whyNotDenoised != view_.whyNotDenoised)
        doWithoutDenoiser(news.whyNotDenoised);
    for (size_t side = 0; side < 2; ++side) {
        if (!news.views[side])
            continue;
        presenter_.setPicture(side, news.views[side]->picture);
        statistics_[side] = std::move(news.views[side]->statistics);
    }
    if (news.inspection)
        takeInspection(*news.inspection);
    for (const std::string& message : news.messages)
        tell(message, false);
    for (const std::string& error : news.errors)
        tell(error, true);
}

// Whoever asked for the denoised picture is told why it does not come.
void Viewer::doWithoutDenoiser(const std::string& why) {
    view_.whyNotDenoised = why;
    for (ShownLayer& shown : view_.shown)
        if (shown.isDenoised) {
            shown = {};
            tell(why, true);
        }
}

void Viewer::receiveScene() {
    const auto outcome = loader_.take();
    if (!outcome)
        return;
    const bool isOther = outcome->order.source != view_.source;
    if (!outcome->scene) {
        tell(outcome->error, true);
        view_.light = view_.settings.lighting;
        view_.ground = view_.settings.ground;
        return;
    }
    for (const std::string& warning : outcome->scene->warnings)
        if (isOther)
            tell(warning, false);
    const std::shared_ptr<const Scene> before = std::exchange(view_.scene, outcome->scene);
    view_.source = outcome->order.source;
    view_.import = outcome->order.import;
    takeLight(outcome->order.lighting, view_.settings.lighting);
    view_.settings.ground = outcome->order.ground;
    if (!view_.scene->environmentMap)
        view_.settings.lighting.rotation = 0.0f;
    if (isOther) {
        view_.settings.layers = view_.asked = 0; // askForPlanes() brings those that are shown
        view_.home = view_.scene->cameras.front();
        view_.homeOptions.clear();
        view_.rig = CameraRig(view_.home, view_.scene->bounds);
    } else if (view_.scene->origin != before->origin) {
        moveOrigin(view_, *before);
    }
    inspection_.reset();
}

void Viewer::receiveShaders() {
    const auto change = watcher_ ? watcher_->take() : std::nullopt;
    if (!change)
        return;
    messages_.clear(); // what they say of shaders from before is no longer so
    if (!change->error.empty())
        tell(change->error + "\nthe kernels from before go on", true);
    if (change->overlay) {
        shaders_ = change->overlay;
        tell(fmt::format("saved {}, changed: {}", fmt::join(change->files, ", "),
                         fmt::join(change->kernels, ", ")),
             false);
        sayWhatTraces();
    }
}

void Viewer::takeInspection(const PixelInspection& inspection) {
    if (inspection.scene != view_.scene)
        return; // another one came in between
    const bool isHit =
        !inspection.path.vertices.empty() && isSurface(inspection.path.vertices.front().surface);
    if (purpose_ == Purpose::look)
        inspection_ = inspection;
    else if (isHit && purpose_ == Purpose::centre)
        view_.rig.centreOn(inspection.path.vertices.front().position);
    else if (isHit)
        view_.rig.focusOn(inspection.path.vertices.front().position);
}

void Viewer::takeKeys() {
    for (const Window::KeyPress& press : window_.takeKeys()) {
        const bool isControl = (press.modifiers & GLFW_MOD_CONTROL) != 0;
        if (press.key == GLFW_KEY_F1)
            view_.showsKeys = !view_.showsKeys;
        else if (isControl && press.key == GLFW_KEY_Q)
            window_.close();
        else if (isControl && press.key == GLFW_KEY_S)
            save();
        else if (ImGui::GetIO().WantCaptureKeyboard || isControl)
            continue;
        else if (press.key == GLFW_KEY_TAB)
            view_.showsPanel = !view_.showsPanel;
        else if (press.key == GLFW_KEY_HOME)
            view_.rig = CameraRig(view_.home, view_.scene->bounds);
        else if (press.key == GLFW_KEY_B)
            view_.isSplit = !view_.isSplit;
        else if (press.key == GLFW_KEY_V)
            stepShown(view_, sideOfMouse(), (press.modifiers & GLFW_MOD_SHIFT) != 0 ? -1 : 1);
        else if (press.key == GLFW_KEY_N)
            toggleDenoised(view_, sideOfMouse());
        else if (press.key == GLFW_KEY_ESCAPE)
            inspection_.reset();
    }
}

size_t Viewer::sideOfMouse() const {
    return view_.isSplit && ImGui::GetIO().MousePos.x > view_.splitAt * points().x ? 1 : 0;
}

void Viewer::takeDrops() {
    for (const std::string& path : window_.takeDrops()) {
        if (hasEnvironmentExtension(path)) {
            view_.light = {};
            view_.light.mapFile = path;
            reload();
        } else {
            loader_.order(
                {path, {.allowsExternal = view_.import.allowsExternal}, view_.light, view_.ground, {}});
        }
    }
}

// All moments of a scene stand on one ground.
void Viewer::reload() {
    const double height = view_.scene->origin.y + double{view_.scene->groundHeight};
    loader_.order({view_.source, view_.import, view_.light, view_.ground, height});
}

void Viewer::save() {
    const std::string name = freeName(view_.source);
    render_.save(name + ".exr", name + ".png");
}

void Viewer::move() {
    const ControlAnswer answer = moveCamera(view_.rig, isChord_, points());
    view_.isFlying = answer.isFlying;
    isLetGo_ = answer.isLetGo && !answer.isFlying;
    if (answer.inspect)
        inspect(*answer.inspect, Purpose::look);
    if (answer.focus)
        inspect(*answer.focus, Purpose::focus);
    if (answer.centre)
        inspect(*answer.centre, Purpose::centre);
}

void Viewer::inspect(const glm::vec2& at, Purpose purpose) {
    const glm::vec2 pixel = at * window_.pixelsPerPoint();
    const glm::vec2 last = glm::vec2(window_.pixels()) - 1.0f;
    purpose_ = purpose;
    inspection_.reset();
    render_.inspect(glm::uvec2(glm::clamp(pixel, glm::vec2(0.0f), last)), 0);
}

void Viewer::draw() {
    if (inspection_) {
        drawPath(*inspection_, view_, points());
        uint32_t sample = 0;
        if (drawInspector(*inspection_, sample))
            render_.inspect(inspection_->pixel, sample);
    }
    if (view_.isSplit)
        drawSplit(view_, points());
    if (view_.showsKeys)
        drawKeys(view_.showsKeys);
    drawMessages(messages_, points());
    if (!view_.showsPanel)
        return;
    const PanelAnswer answer = drawPanel(view_, {statistics_[0], statistics_[1]});
    if (answer.wantsSave)
        save();
    if (answer.wantsScene)
        reload();
}

void Viewer::send() {
    const glm::uvec2 pixels = window_.pixels();
    if (pixels.x == 0 || pixels.y == 0)
        return; // minimised: the image is kept
    view_.settings.image.width = pixels.x;
    view_.settings.image.height = pixels.y;
    // For the record of saved images.
    view_.settings.provenance.cameraOptions =
        view_.rig.camera() == view_.home
            ? view_.homeOptions
            : cameraOptions(view_.rig, static_cast<float>(pixels.x) / static_cast<float>(pixels.y),
                            view_.scene->origin);
    if (!view_.isSplit) {
        view_.other = view_.settings.estimator;
        view_.shown[1] = view_.shown[0];
    }
    askForPlanes(view_);
    LiveRequest request{
        view_.scene, view_.rig.camera(), view_.settings,       std::nullopt, shaders_,      view_.tone,
        false,       view_.isSplit,      view_.exposesByImage, view_.shown,  view_.quality, view_.asked};
    if (view_.isSplit && view_.other != view_.settings.estimator)
        request.other = view_.other;
    if (sent_ && sent_->camera != request.camera && sent_->scene == request.scene)
        lastMove_ = Clock::now();
    if (isLetGo_)
        lastMove_ = {};
    request.isMoving = Clock::now() - lastMove_ < kStillAfter;
    if (sent_ && *sent_ == request)
        return;
    if (inspection_ && (!sent_ || restartsImage(*sent_, request) != Restart::nothing))
        inspection_.reset(); // it was of another image
    if (watcher_)
        watcher_->use(watchedKernels(request.settings));
    sent_ = request;
    isReady_ = false;
    render_.show(request);
}

void Viewer::updateTitle() {
    const uint32_t samples = statistics_[0] ? statistics_[0]->samples : 0;
    const char* state = loader_.isBusy() ? ", loading"
                        : !isReady_      ? ", preparing"
                        : isFinished_    ? ", done"
                                         : "";
    std::string title = fmt::format("Lavalight: {}, {} samples{}",
                                    std::filesystem::path(view_.source).filename().string(), samples, state);
    if (title != title_)
        window_.setTitle(title);
    title_ = std::move(title);
}

} // namespace lavalight
