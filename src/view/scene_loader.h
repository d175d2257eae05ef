// Reads scenes while the window goes on.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "gltf/import_options.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight {

// Which scene, which moment of it, under which light, above which ground.
struct SceneOrder {
    std::string source;
    ImportOptions import;
    LightingSettings lighting;
    GroundSettings ground;
    std::optional<double> groundHeight; // in the world; none: right below the scene
};

class SceneLoader {
  public:
    // Throws Error for what is no scene.
    using Load = std::function<Scene(const SceneOrder& order)>;
    // `wake` is called, from another thread, once there is an outcome.
    SceneLoader(Load load, std::function<void()> wake) : load_(std::move(load)), wake_(std::move(wake)) {}

    // The newest order counts; it waits for the one under way.
    void order(const SceneOrder& order);

    struct Outcome {
        SceneOrder order;
        std::shared_ptr<const Scene> scene; // null: it failed
        std::string error;
    };
    // Takes the outcome of an order, once.
    [[nodiscard]] std::optional<Outcome> take();
    [[nodiscard]] bool isBusy() const { return thread_.joinable(); }

  private:
    void start(const SceneOrder& order);

    Load load_;
    std::function<void()> wake_;
    std::optional<SceneOrder> next_;
    std::mutex mutex_;               // guards outcome_
    std::optional<Outcome> outcome_; // outcome of the order under way
    std::jthread thread_;            // last: ends before all else goes
};

} // namespace lavalight
