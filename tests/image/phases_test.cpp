// Phases: what they share, and that cutting a render into phases changes no bit of it.
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "device_scene/scene_features.h"
#include "gpu/commands.h"
#include "render/film.h"
#include "render/renderer.h"
#include "render/schedule_choice.h"
#include "session/builtin.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSize = 24;

class Phases : public DeviceTest {
  protected:
    void use(Schedule schedule) {
        settings_ = imageSettings(kSize, kSize, 16);
        settings_.work.schedule = schedule;
        settings_ = resolveSchedule(settings_, device().description());
        settings_.work.waveSize = 2048;
    }
    // Words of the film that these phases make.
    [[nodiscard]] std::vector<uint32_t> filmOf(const std::vector<Phase>& phases) {
        const Camera& camera = scene_.cameras.front();
        const Lights lights = collectLights(scene_, scene_.environment, LightSelection::power);
        const SceneFeatures features = sceneFeatures(scene_, lights) | cameraFeatures(camera);
        const Schedule schedule = settings_.work.schedule;
        const MaterialClasses classes = materialClasses(scene_);
        const EstimatorKernels kernels(device(), kernelVariants(phases, schedule, classes),
                                       settings_.estimator, features, filmPlanes(settings_), embeddedKernel);
        const AcceleratorKind accelerator =
            schedule == Schedule::hosted ? AcceleratorKind::bvh16 : AcceleratorKind::bvh8;
        const GpuScene gpuScene(device(), packScene(scene_, lights, accelerator));
        FrameParameters frame = makeFrame(scene_, camera, settings_);
        setLights(frame, lights);
        const gpu::Buffer noLayers(device(), "no layers of triangles", 0, gpu::BufferUse::storage);
        const Film film(device(), kSize, kSize, 0);
        const auto kernel = [&](std::string_view name) -> const gpu::Kernel& { return kernels[name]; };
        const auto waves =
            makeWaveRenderer(device(), {phases, schedule, gpuScene, gpuScene.albedoTable().buffer, noLayers,
                                        film, frame, kernel, classes, features});
        WaveWalk walk(phases, {.bandPixels = {kSize * kSize}, .waveSize = settings_.work.waveSize});
        while (!walk.isDone()) {
            const Wave wave = walk.next(settings_.work.waveSize);
            waves->renderWave(*wave.transport, wave.band, wave.range);
            walk.goPast(wave);
        }
        waves->finish();
        return film.read().words;
    }

    const Scene scene_ = loadScene("cornell-box");
    RenderSettings settings_;
};

// The second transport has steps of its own where the wavefront can tell: all of them before the first
// bounce's queues are asked for. A path's first vertex is then found twice, which changes nothing.
TEST_F(Phases, EachTakeTheirSamplesByTheirTransport) {
    const std::vector<KernelStep> twice{{"generate", Over::slots}, {"extend", Over::rays}};
    Transport other = kPathTransport;
    other.start = twice;
    for (const Schedule schedule : schedulesOf(device())) {
        use(schedule);
        const std::vector<uint32_t> whole = filmOf({{&kPathTransport, 0, 16}});
        EXPECT_EQ(filmOf({{&kPathTransport, 0, 5}, {&other, 5, 11}}), whole);
        EXPECT_EQ(filmOf({{&other, 5, 11}, {&kPathTransport, 0, 5}}), whole);
        EXPECT_NE(filmOf({{&kPathTransport, 0, 5}, {&other, 6, 11}}), whole) << "other samples";
    }
}

// Without connect no light that is sampled arrives.
TEST_F(Phases, RunTheStepsOfTheirTransportAlone) {
    const std::vector<KernelStep> blind{
        {"extend", Over::rays}, {"shade", Over::rays}, {"prepare", Over::once}};
    Transport other = kPathTransport;
    other.bounce = blind;
    use(Schedule::wavefront);
    const std::vector<uint32_t> dark = filmOf({{&other, 0, 16}});
    EXPECT_NE(dark, filmOf({{&kPathTransport, 0, 16}}));
    EXPECT_NE(dark, filmOf({{&kPathTransport, 0, 1}, {&other, 1, 15}}));
}

TEST_F(Phases, ShareKernels) {
    const std::vector<Phase> phases{{&kPathTransport, 0, 8}, {&kPathTransport, 8, 8}};
    EXPECT_EQ(kernelNames(phases, Schedule::fused), (std::vector<std::string_view>{"path", "accumulate"}));
    EXPECT_EQ(
        kernelNames(phases, Schedule::wavefront),
        (std::vector<std::string_view>{"generate", "extend", "shade", "prepare", "connect", "accumulate"}));
    EXPECT_EQ(
        kernelNames(phases, Schedule::hosted),
        (std::vector<std::string_view>{"hosted/camera", "hosted/scatter", "hosted/escape", "accumulate"}));
}

} // namespace
} // namespace lavalight::test
