// The window: shows a scene while it is rendered, and what the user does with it.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "view/live_render.h"
#include "view/presenter.h"
#include "view/scene_loader.h"
#include "view/shader_watcher.h"
#include "view/view_state.h"
#include "view/window.h"

namespace lavalight {

struct ViewerConfig {
    ViewState view; // holds the scene; settings.image has the window's size
    gpu::DeviceConfig device;
    std::shared_ptr<ShaderOverlay> shaders; // null: as built
    std::string watched;                    // folder whose shaders are compiled at every save; empty: none
};

class Viewer {
  public:
    // Opens the window and the devices. Throws Error where there is no desktop, or no device.
    explicit Viewer(ViewerConfig config);
    // Runs until the window is closed. Throws Error where the device is lost.
    void run();

  private:
    // What an inspection that is under way is for.
    enum class Purpose { look, centre, focus };

    void receive();
    void doWithoutDenoiser(const std::string& why);
    void receiveScene();
    void receiveShaders();
    void takeInspection(const PixelInspection& inspection);
    void takeKeys();
    void takeDrops();
    void reload();
    void save();
    void draw();
    void move();
    void inspect(const glm::vec2& at, Purpose purpose);
    void send();
    void tell(const std::string& text, bool isError);
    void sayWhatTraces(); // where shaders keep the host from it
    void updateTitle();
    [[nodiscard]] size_t sideOfMouse() const;
    [[nodiscard]] std::vector<std::string> watchedKernels(const RenderSettings& settings) const;
    [[nodiscard]] double patience() const;
    [[nodiscard]] glm::vec2 points() const; // size of the window in screen coordinates

    ViewState view_;
    Window window_;
    Presenter presenter_;
    LiveRender render_;
    SceneLoader loader_;
    std::shared_ptr<ShaderOverlay> shaders_;
    std::optional<ShaderWatcher> watcher_;
    std::optional<LiveRequest> sent_;
    std::array<std::optional<LiveStatistics>, 2> statistics_;
    std::optional<PixelInspection> inspection_;
    Purpose purpose_ = Purpose::look;
    std::vector<std::pair<std::string, bool>> messages_; // and whether each is an error
    std::chrono::steady_clock::time_point lastMove_{};
    bool isChord_ = false; // moveCamera()
    bool isLetGo_ = false; // a drag ended in this frame: the camera stays
    int unsettled_ = 0;    // frames
    bool isReady_ = false;
    bool isFinished_ = false;
    std::string title_;
};

} // namespace lavalight
