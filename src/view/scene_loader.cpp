#include "view/scene_loader.h"

#include <chrono>
#include <utility>

namespace lavalight {

void SceneLoader::order(const SceneOrder& order) {
    if (isBusy())
        next_ = order;
    else
        start(order);
}

void SceneLoader::start(const SceneOrder& order) {
    current_ = std::async(std::launch::async, [this, order] {
        Outcome outcome{order, nullptr, {}};
        try {
            outcome.scene = std::make_shared<const Scene>(load_(order));
        } catch (const std::exception& error) {
            outcome.error = error.what();
        }
        wake_();
        return outcome;
    });
}

std::optional<SceneLoader::Outcome> SceneLoader::take() {
    if (!isBusy() || current_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    Outcome outcome = current_.get();
    if (next_)
        start(*std::exchange(next_, std::nullopt));
    return outcome;
}

} // namespace lavalight
