// A render in a thread of its own: what it shows is what a render of the same settings makes, whatever was
// asked before.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "base/file.h"
#include "image/exr.h"
#include "inspect/path_inspector.h"
#include "render/renderer.h"
#include "render/tone_mapper.h"
#include "session/builtin.h"
#include "support/temporary_folder.h"
#include "support/test_device.h"
#include "view/live_render.h"

namespace lavalight::test {
namespace {

LiveRequest requestFor(const std::string& scene, uint32_t samples = 8) {
    LiveRequest request;
    request.scene = std::make_shared<const Scene>(loadScene(scene));
    request.camera = request.scene->cameras.front();
    request.settings.image.width = 40;
    request.settings.image.height = 30;
    request.settings.stop.samples = samples;
    request.settings.work.schedule = Schedule::fused;
    return request;
}

class LiveRenderTest : public DeviceTest {
  protected:
    // News, one after another, until that holds of them; the newest view and inspection of all.
    template <typename Condition>
    LiveNews waitFor(const Condition& condition) {
        LiveNews all;
        do {
            LiveNews news = render_.news();
            for (size_t side = 0; side < 2; ++side)
                if (news.views[side])
                    all.views[side] = std::move(news.views[side]);
            if (news.inspection)
                all.inspection = std::move(news.inspection);
            all.messages.insert(all.messages.end(), news.messages.begin(), news.messages.end());
            all.errors.insert(all.errors.end(), news.errors.begin(), news.errors.end());
            all.isReady = news.isReady;
            all.isFinished = news.isFinished;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } while (!condition(all));
        return all;
    }
    LiveNews waitForImage() {
        return waitFor([](const LiveNews& news) { return news.isReady && news.isFinished; });
    }
    PixelInspection inspect(const glm::uvec2& pixel) {
        render_.inspect(pixel, 0);
        return *waitFor([](const LiveNews& news) { return news.inspection.has_value(); }).inspection;
    }
    // Without a thread.
    [[nodiscard]] std::vector<uint32_t> expected(const LiveRequest& request) {
        Renderer renderer(device(), *request.scene, request.camera, request.settings);
        renderer.render([](double) { return true; });
        return ToneMapper(device()).map(renderer.film(), request.tone);
    }

    LiveRender render_{testDeviceConfig(), [] {}};
};

TEST_F(LiveRenderTest, ShowsTheImageOfARender) {
    const LiveRequest request = requestFor("cornell-box");
    render_.show(request);
    const LiveNews news = waitForImage();
    ASSERT_TRUE(news.views[0]);
    EXPECT_EQ(news.views[0]->picture.width, 40u);
    EXPECT_EQ(news.views[0]->picture.height, 30u);
    EXPECT_EQ(news.views[0]->picture.pixels, expected(request));
    EXPECT_EQ(news.views[0]->statistics.samples, 8u);
    EXPECT_EQ(news.views[0]->statistics.paths, 8u * 40u * 30u);
    EXPECT_FALSE(news.views[1]);
}

TEST_F(LiveRenderTest, ShowsTwoSettingsEachWithItsOwnImage) {
    LiveRequest request = requestFor("cornell-box");
    request.other = request.settings.estimator;
    request.isSplit = true;
    request.other->nextEventEstimation = false;
    render_.show(request);
    const LiveNews news = waitFor([](const LiveNews& n) { return n.isFinished && n.views[1]; });
    EXPECT_EQ(news.views[0]->picture.pixels, expected(request));
    LiveRequest other = request;
    other.settings.estimator = *request.other;
    EXPECT_EQ(news.views[1]->picture.pixels, expected(other));
}

TEST_F(LiveRenderTest, PathsAreOfTheSceneThatWasRendered) {
    const LiveRequest box = requestFor("cornell-box");
    const LiveRequest plates = requestFor("veach-mis");
    render_.show(box);
    (void)waitForImage();
    const PixelInspection inBox = inspect({20, 15});
    EXPECT_EQ(inBox.scene, box.scene);
    EXPECT_EQ(inBox.pixel, glm::uvec2(20, 15));
    EXPECT_EQ(inBox.count, 8u);
    ASSERT_FALSE(inBox.path.vertices.empty());
    render_.show(plates);
    EXPECT_EQ(inspect({20, 15}).scene, plates.scene) << "what is asked at once waits for the image";
}

// A kernel that follows paths serves until settings or shaders change.
TEST_F(LiveRenderTest, PathsAreOfTheEstimatorAndShadersThatAreShown) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "lib/bsdf");
    std::string diffuse = readFile(LAVALIGHT_SOURCE_DIR "/shaders/lib/bsdf/diffuse.glsl");
    diffuse.insert(diffuse.find("kInvPi * max"), "0.9 * ");
    std::ofstream(folder / "lib/bsdf/diffuse.glsl") << diffuse;
    const LiveRequest plain = requestFor("cornell-box");
    LiveRequest scattered = plain; // without light samples
    scattered.settings.estimator.nextEventEstimation = false;
    LiveRequest darker = plain;
    darker.shaders = std::make_shared<ShaderOverlay>(folder.path());
    std::set<float> different;
    for (const LiveRequest& request : {plain, darker, scattered}) {
        render_.show(request);
        const float shown = inspect({12, 22}).path.radiance.g;
        const KernelSource source = sourceOf(request.shaders);
        const Renderer renderer(device(), *request.scene, request.camera, request.settings, source);
        EXPECT_EQ(shown, PathInspector(device(), renderer, source).trace(renderer, {12, 22}, 0).radiance.g);
        different.insert(shown);
    }
    EXPECT_EQ(different.size(), 3u);
}

// A click, then a smaller window before it is answered.
TEST_F(LiveRenderTest, APixelBeyondTheImageIsTheNearestOne) {
    LiveRequest request = requestFor("cornell-box");
    render_.show(request);
    (void)waitForImage();
    request.settings.image.width = 20;
    request.settings.image.height = 15;
    render_.show(request);
    EXPECT_EQ(inspect({4000, 3000}).pixel, glm::uvec2(19, 14));
}

// Clicks that come faster than paths are traced do not keep the next order, or the end, waiting.
TEST_F(LiveRenderTest, OnlyTheNewestClickIsAnswered) {
    render_.show(requestFor("cornell-box"));
    (void)waitForImage();
    const auto before = std::chrono::steady_clock::now();
    for (uint32_t i = 0; i < 100'000; ++i)
        render_.inspect({i % 40, 7}, 0);
    (void)waitFor([](const LiveNews& n) { return n.inspection && n.inspection->pixel == glm::uvec2(39, 7); });
    EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(20));
}

TEST_F(LiveRenderTest, OrdersOfEveryKindInAnyOrderEndInTheImageOfTheLastOne) {
    const TemporaryFolder folder;
    const LiveRequest last = requestFor("cornell-box");
    const LiveRequest scenes[] = {requestFor("veach-mis", 64), requestFor("cornell-glass", 64), last};
    std::mt19937 random(3);
    for (int i = 0; i < 25; ++i) {
        LiveRequest request = scenes[random() % 3];
        request.isMoving = random() % 2 == 0;
        request.settings.image.width += static_cast<uint32_t>(random() % 2);
        request.camera.position.x += 0.01f * static_cast<float>(random() % 3);
        if (random() % 3 == 0)
            request.other = EstimatorSettings{};
        request.isSplit = request.other.has_value();
        render_.show(request);
        if (random() % 2 == 0)
            render_.inspect({random() % 40, random() % 30}, 0);
        if (random() % 8 == 0)
            render_.save((folder / std::to_string(i)).string() + ".exr", "");
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 40));
        EXPECT_TRUE(render_.news().errors.empty());
    }
    render_.show(last);
    EXPECT_EQ(waitForImage().views[0]->picture.pixels, expected(last));
}

TEST_F(LiveRenderTest, SavesTheImageAndSaysSo) {
    const TemporaryFolder folder;
    render_.show(requestFor("cornell-box"));
    (void)waitForImage();
    render_.save((folder / "a.exr").string(), (folder / "a.png").string());
    render_.save((folder / "none/a.exr").string(), "");
    const LiveNews news = waitFor([](const LiveNews& n) { return !n.messages.empty() && !n.errors.empty(); });
    EXPECT_EQ(news.messages.front(),
              "saved " + (folder / "a.exr").string() + ", " + (folder / "a.png").string());
    EXPECT_NE(news.errors.front().find("cannot write"), std::string::npos) << news.errors.front();
    const std::vector<uint32_t> counts = readExr(folder / "a.exr").sampleCounts;
    EXPECT_EQ(counts, std::vector<uint32_t>(40 * 30, 8));
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
}

TEST_F(LiveRenderTest, ASavedImageNamesTheShadersThatWereChanged) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "lib/sampling");
    std::ofstream(folder / "lib/sampling/roulette.glsl")
        << *embeddedShader("lib/sampling/roulette.glsl") << "// another line\n";
    LiveRequest request = requestFor("cornell-box");
    request.shaders = std::make_shared<ShaderOverlay>(folder.path());
    render_.show(request);
    (void)waitForImage();
    render_.save((folder / "a.exr").string(), "");
    (void)waitFor([](const LiveNews& n) { return !n.messages.empty(); });
    std::string ledger;
    for (const auto& [key, value] : readExr(folder / "a.exr").metadata)
        if (key == "bias-ledger")
            ledger = value;
    EXPECT_NE(ledger.find("lib/sampling/roulette.glsl"), std::string::npos) << ledger;
}

TEST_F(LiveRenderTest, WhatCannotBeRenderedIsToldAndTheImageBeforeGoesOn) {
    const LiveRequest before = requestFor("cornell-box");
    render_.show(before);
    (void)waitForImage();
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "lib/sampling");
    std::ofstream(folder / "lib/sampling/roulette.glsl") << "this is no shader";
    LiveRequest broken = requestFor("veach-mis");
    broken.shaders = std::make_shared<ShaderOverlay>(folder.path());
    render_.show(broken);
    const LiveNews news = waitFor([](const LiveNews& n) { return !n.errors.empty() && n.isFinished; });
    EXPECT_NE(news.errors.front().find("lib/sampling/roulette.glsl:1"), std::string::npos)
        << news.errors.front();
    EXPECT_EQ(inspect({20, 15}).scene, before.scene);
    LiveRequest next = before;
    next.settings.estimator.seed = 5;
    render_.show(next);
    EXPECT_EQ(waitForImage().views[0]->picture.pixels, expected(next));
}

TEST_F(LiveRenderTest, EndsWithTheWaveUnderWay) {
    for (const int milliseconds : {0, 1, 10, 50, 200}) {
        auto render = std::make_unique<LiveRender>(testDeviceConfig(), [] {});
        render->show(requestFor("cornell-glass", 1u << 30));
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        const auto before = std::chrono::steady_clock::now();
        render.reset();
        EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(60));
    }
}

} // namespace
} // namespace lavalight::test
