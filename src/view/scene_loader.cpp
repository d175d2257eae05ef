#include "view/scene_loader.h"

#include <utility>

namespace lavalight {

void SceneLoader::order(const SceneOrder& order) {
    if (isBusy())
        next_ = order;
    else
        start(order);
}

void SceneLoader::start(const SceneOrder& order) {
    thread_ = std::jthread([this, order] {
        Outcome outcome{order, nullptr, {}};
        try {
            outcome.scene = std::make_shared<const Scene>(load_(order));
        } catch (const std::exception& error) {
            outcome.error = error.what();
        }
        {
            const std::lock_guard lock(mutex_);
            outcome_ = std::move(outcome);
        }
        wake_();
    });
}

std::optional<SceneLoader::Outcome> SceneLoader::take() {
    std::optional<Outcome> outcome;
    {
        const std::lock_guard lock(mutex_);
        outcome = std::exchange(outcome_, std::nullopt);
    }
    if (!outcome)
        return std::nullopt;
    thread_.join();
    if (next_)
        start(*std::exchange(next_, std::nullopt));
    return outcome;
}

} // namespace lavalight
