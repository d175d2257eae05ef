// Ways of working that graphics cards and other drivers need, tried on the device at hand: the bits stay.
#include <vector>

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "session/builtin.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class DeviceMemory : public DeviceTest {
  protected:
    // A device that does it the other way must render the films of the one that does not.
    void expectSameFilms(const gpu::DeviceConfig& config) {
        gpu::Device other(config);
        for (const char* name : {"cornell-glass", "many-lights"}) {
            const Scene scene = loadScene(name);
            RenderSettings settings = imageSettings(24, 20, 4);
            std::vector<WorkSettings> ways{{.schedule = Schedule::fused}, {.schedule = Schedule::wavefront}};
            if (device().tracesRays())
                ways.push_back({.schedule = Schedule::fused, .accelerator = RayAccelerator::rayQuery});
            for (const WorkSettings& work : ways) {
                settings.work = work;
                EXPECT_EQ(renderScene(other, scene, settings, embeddedKernel).filmWords,
                          renderScene(device(), scene, settings).filmWords)
                    << name;
            }
        }
        other.requireNoValidationMessages();
    }
};

TEST_F(DeviceMemory, BuffersThatAreNotMappedHoldTheSame) {
    gpu::DeviceConfig config = testDeviceConfig();
    config.stagesBuffers = true;
    expectSameFilms(config);
}

TEST_F(DeviceMemory, StorageBuffersInPlaceOfTexelBuffersHoldTheSame) {
    gpu::DeviceConfig config = testDeviceConfig();
    config.storesTexels = true;
    expectSameFilms(config);
}

// Many small waves, whose paths are longer than what is submitted at once.
TEST_F(DeviceMemory, WorkThatIsSubmittedAheadCountsTheSame) {
    gpu::DeviceConfig config = testDeviceConfig();
    config.runsAhead = true;
    gpu::Device other(config);
    const Scene scene = loadScene("cornell-glass");
    RenderSettings settings = imageSettings(24, 20, 8);
    settings.work.schedule = Schedule::wavefront;
    settings.work.waveSize = 1000;
    for (const uint32_t bounces : {5u, 64u}) {
        settings.estimator.maxBounces = bounces;
        settings.estimator.roulette = Roulette::off;
        Renderer direct(device(), scene, scene.cameras.front(), settings);
        Renderer ahead(other, scene, scene.cameras.front(), settings);
        direct.render([](double) { return true; });
        ahead.render([](double) { return true; });
        EXPECT_EQ(ahead.film().read().words, direct.film().read().words);
        EXPECT_EQ(ahead.waves().raysPerBounce(), direct.waves().raysPerBounce());
        EXPECT_EQ(ahead.waves().rays().shadow, direct.waves().rays().shadow);
        EXPECT_GT(ahead.waves().raysPerBounce()[bounces > 8 ? 17 : 5], 0u) << "the paths are not long enough";
    }
    other.requireNoValidationMessages();
}

} // namespace
} // namespace lavalight::test
