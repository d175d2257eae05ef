// A driver that refuses one call while an image is changed: the image from before goes on with its own bits,
// and the change can be made once the driver agrees.
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "render/tone_mapper.h"
#include "session/builtin.h"
#include "support/faults/faults.h"
#include "support/temporary_folder.h"
#include "view/live_side.h"

namespace lavalight::test {
namespace {

constexpr int kOutOfDeviceMemory = -2;

LiveRequest smallRequest(Schedule schedule) {
    LiveRequest request;
    request.scene = std::make_shared<const Scene>(loadScene("cornell-box"));
    request.camera = request.scene->cameras.front();
    request.settings.image.width = 8;
    request.settings.image.height = 6;
    request.settings.stop.samples = 2;
    request.settings.work.waveSize = 4096;
    request.settings.estimator.maxBounces = 4;
    request.settings.work.schedule = schedule;
    return request;
}

class LiveFault : public testing::Test {
  protected:
    // The image of the side's request, once all its samples are taken.
    [[nodiscard]] std::vector<uint32_t> finish() {
        while (side_.hasWork())
            side_.step();
        return side_.view({}, 0.0f).picture.pixels;
    }
    [[nodiscard]] std::vector<uint32_t> finish(const LiveRequest& request) {
        side_.show(request);
        return finish();
    }

    // Every `stride`-th call of the change from one request to another fails once.
    void expectEveryCallMayFail(LiveRequest shown, LiveRequest wanted, long first = 1, long stride = 1) {
        std::vector<uint32_t> before = finish(shown);
        std::vector<uint32_t> after = finish(wanted);
        ASSERT_NE(before, after);
        ASSERT_EQ(finish(shown), before);
        for (long call = first;; call += stride) {
            faults_.failAt(call, kOutOfDeviceMemory);
            bool hasFailed = false;
            try {
                side_.show(wanted);
            } catch (const Error&) {
                hasFailed = true;
            }
            const std::string failed = faults_.failure();
            faults_.failNone();
            SCOPED_TRACE("call " + std::to_string(call) + " " + failed);
            if (failed.empty()) {
                EXPECT_GT(call, 20);
                return;
            }
            ASSERT_TRUE(hasFailed);
            ASSERT_EQ(finish(), before);
            ASSERT_EQ(finish(wanted), after);
            std::swap(shown, wanted); // what is shown now is where the next change starts
            std::swap(before, after);
        }
    }

    const FaultyDevices faults_;
    gpu::Device device_{{}};
    ToneMapper tone_{device_};
    LiveSide side_{device_, tone_};
};

TEST_F(LiveFault, AnyCallOfAMoveMayFail) {
    for (const Schedule schedule : {Schedule::fused, Schedule::wavefront}) {
        const LiveRequest shown = smallRequest(schedule);
        LiveRequest moved = shown;
        moved.camera.position.x += 0.1f;
        expectEveryCallMayFail(shown, moved);
    }
}

TEST_F(LiveFault, AnyCallOfAChangeOfSizeMayFail) {
    const LiveRequest shown = smallRequest(Schedule::fused);
    LiveRequest larger = shown;
    larger.settings.image.width += 3;
    larger.settings.image.height += 2;
    expectEveryCallMayFail(shown, larger);
}

// Each test takes a third of the calls, so that the three run side by side: each compiles kernels.
class LiveSettingsFault : public LiveFault, public testing::WithParamInterface<long> {};

TEST_P(LiveSettingsFault, AnyCallMayFail) {
    LiveRequest shown = smallRequest(Schedule::fused);
    shown.settings.estimator.nextEventEstimation = false;
    LiveRequest other = shown;
    other.settings.estimator.hemisphere = Hemisphere::uniform;
    expectEveryCallMayFail(shown, other, 1 + GetParam(), 3);
}

INSTANTIATE_TEST_SUITE_P(Thirds, LiveSettingsFault, testing::Range<long>(0, 3));

TEST_F(LiveFault, AnyCallOfAReloadOfShadersMayFail) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "scene");
    std::string sink = readFile(LAVALIGHT_SOURCE_DIR "/shaders/scene/film_sink.glsl");
    const std::string radiance = "paths[slot].radiance;\n}"; // what is added to the colour
    ASSERT_NE(sink.find(radiance), std::string::npos);
    sink.insert(sink.rfind(radiance), "0.5 * ");
    std::ofstream(folder / "scene/film_sink.glsl") << sink;
    const LiveRequest shown = smallRequest(Schedule::fused);
    LiveRequest darker = shown;
    darker.shaders = std::make_shared<ShaderOverlay>(folder.path());
    expectEveryCallMayFail(shown, darker);
}

} // namespace
} // namespace lavalight::test
