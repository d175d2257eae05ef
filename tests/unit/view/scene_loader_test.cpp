// Reading scenes beside what goes on.
#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include <gtest/gtest.h>

#include "base/error.h"
#include "view/scene_loader.h"

namespace lavalight {
namespace {

SceneLoader::Outcome wait(SceneLoader& loader) {
    for (;;) {
        if (auto outcome = loader.take())
            return *outcome;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

TEST(SceneLoader, BringsASceneOrWhatIsWrongWithIt) {
    std::atomic<int> calls = 0;
    SceneLoader loader(
        [](const SceneOrder& order) {
            if (order.source == "broken")
                throw Error("it is broken");
            Scene scene;
            scene.source = order.source;
            return scene;
        },
        [&] { ++calls; });
    EXPECT_FALSE(loader.isBusy());
    EXPECT_FALSE(loader.take());
    loader.order({"whole", {}, {}, {}, {}});
    EXPECT_TRUE(loader.isBusy());
    const SceneLoader::Outcome whole = wait(loader);
    ASSERT_NE(whole.scene, nullptr);
    EXPECT_EQ(whole.scene->source, "whole");
    EXPECT_EQ(whole.error, "");
    EXPECT_FALSE(loader.isBusy());
    loader.order({"broken", {}, {}, {}, {}});
    const SceneLoader::Outcome broken = wait(loader);
    EXPECT_EQ(broken.scene, nullptr);
    EXPECT_EQ(broken.error, "it is broken");
    EXPECT_EQ(calls, 2);
}

TEST(SceneLoader, LeavesOutOrdersThatAreOutdatedBeforeTheyBegin) {
    std::promise<void> go;
    const std::shared_future<void> mayGoOn = go.get_future().share();
    std::atomic<int> loads = 0;
    SceneLoader loader(
        [&](const SceneOrder&) {
            mayGoOn.wait();
            ++loads;
            return Scene();
        },
        [] {});
    for (const char* source : {"a", "b", "c", "d"})
        loader.order({source, {}, {}, {}, {}});
    go.set_value();
    EXPECT_EQ(wait(loader).order.source, "a");
    EXPECT_EQ(wait(loader).order.source, "d");
    EXPECT_FALSE(loader.isBusy());
    EXPECT_EQ(loads, 2);
}

} // namespace
} // namespace lavalight
