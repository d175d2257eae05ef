// One scene, one set of settings and one seed give the same bits, however the work is cut up.
#include <gtest/gtest.h>

#include "render/setting_names.h"
#include "session/builtin.h"
#include "shared/wavefront.h"
#include "support/patched_kernel.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class Determinism : public DeviceTest {
  protected:
    // 40 x 36 pixels: neither waves nor bands divide them evenly.
    [[nodiscard]] static RenderSettings baseSettings() { return imageSettings(40, 36, 16); }

    [[nodiscard]] std::vector<uint32_t> filmOf(const RenderSettings& settings) {
        return renderScene(device(), scene_, settings).filmWords;
    }

    const Scene scene_ = loadScene("cornell-box");
};

TEST_F(Determinism, TwoRendersHaveEqualBits) {
    EXPECT_EQ(filmOf(baseSettings()), filmOf(baseSettings()));
}

TEST_F(Determinism, AnotherSeedIsAnotherImageOfTheSameMean) {
    RenderSettings settings = baseSettings();
    const RenderResult first = renderScene(device(), scene_, settings);
    settings.estimator.seed = 7;
    const RenderResult second = renderScene(device(), scene_, settings);
    EXPECT_NE(first.filmWords, second.filmWords);
    expectSameMean(first.rendering, second.rendering, 20);
}

TEST_F(Determinism, WaveSizeChangesNoBit) {
    // With many triangles, the fused kernel puts paths by after their first
    // vertex.
    for (const Scene& scene : {scene_, loadScene("dense-12000")}) {
        for (const Schedule schedule : schedulesOf(device())) {
            RenderSettings settings = baseSettings();
            settings.work.schedule = schedule;
            const std::vector<uint32_t> expected = renderScene(device(), scene, settings).filmWords;
            for (const uint32_t waveSize : {1000u, 4096u, 10007u, 65536u}) {
                settings.work.waveSize = waveSize;
                EXPECT_EQ(renderScene(device(), scene, settings).filmWords, expected)
                    << scene.source << ", " << nameOf(schedule) << ", " << waveSize;
            }
        }
    }
}

// Whole paths in one kernel, many dispatches for each of them where paths are
// long.
TEST_F(Determinism, FusedKernelsAndTheWavefrontGiveTheSameBits) {
    for (const char* name : {"cornell-glass", "veach-mis", "many-lights", "nested-glass"}) {
        const Scene scene = loadScene(name);
        RenderSettings settings =
            imageSettings(40, 36, 130); // lanes of several slots, the last ones not full
        settings.estimator.roulette = Roulette::off;
        settings.estimator.maxBounces = 2 * kVerticesPerDispatch;
        settings.work.schedule = Schedule::fused;
        const RenderResult fused = renderScene(device(), scene, settings);
        settings.work.schedule = Schedule::wavefront;
        const RenderResult wavefront = renderScene(device(), scene, settings);
        EXPECT_EQ(fused.filmWords, wavefront.filmWords) << name;
        EXPECT_EQ(fused.tallies.cutPaths, wavefront.tallies.cutPaths) << name;
        EXPECT_NEAR(fused.tallies.cutThroughput, wavefront.tallies.cutThroughput, 1e-9) << name;
    }
}

// The host finds the triangles that kernels find. A path that passes an edge within rounding may take another
// way.
TEST_F(Determinism, TheHostGivesThePictureOfTheKernelsButForRounding) {
    if (!device().description().sharesMemory)
        GTEST_SKIP() << "the host does not reach the device's memory";
    for (const char* name : {"cornell-glass", "veach-mis", "nested-glass", "lamps-200", "dense-12000"}) {
        const Scene scene = loadScene(name);
        RenderSettings settings = imageSettings(40, 36, 16);
        settings.work.schedule = Schedule::fused;
        const RenderResult kernels = renderScene(device(), scene, settings);
        settings.work.schedule = Schedule::hosted;
        const RenderResult host = renderScene(device(), scene, settings);
        EXPECT_LE(shareThatDiffers(kernels.rendering, host.rendering), 0.005) << name;
        EXPECT_EQ(kernels.tallies.cutPaths, host.tallies.cutPaths) << name;
    }
}

// The device finds them, too.
TEST_F(Determinism, RayQueriesGiveThePictureOfOurOwnTreeButForRounding) {
    if (!device().tracesRays())
        GTEST_SKIP() << "the device has no VK_KHR_ray_query";
    for (const char* name : {"cornell-glass", "veach-mis", "nested-glass", "lamps-200", "dense-12000"}) {
        const Scene scene = loadScene(name);
        RenderSettings settings = imageSettings(40, 36, 16);
        settings.work = {.schedule = Schedule::fused, .accelerator = RayAccelerator::bvh8};
        const RenderResult ours = renderScene(device(), scene, settings);
        settings.work.accelerator = RayAccelerator::rayQuery;
        const RenderResult queries = renderScene(device(), scene, settings);
        EXPECT_LE(shareThatDiffers(ours.rendering, queries.rendering), 0.005) << name;
        EXPECT_EQ(ours.tallies.cutPaths, queries.tallies.cutPaths) << name;
    }
}

// What a scene has not is left out of its kernels: with everything left in, the
// bits are the same. Not with the colours of vertices, for there are none to
// multiply, nor with thin films and brushed lobes, whose arithmetic rounds
// otherwise where they have no effect (measured: 0.3 % and 0.1 % of the film's
// words), nor with kinds of cameras, nor with lights, an environment among
// them, or a map where there is none, nor with many triangles, which alone have
// memory for paths to wait in, nor with lists of solids, whose rays start on the very point.
TEST_F(Determinism, KernelsSpecialisedToTheSceneGiveTheBitsOfGeneralOnes) {
    for (const char* name : {"cornell-glass", "veach-mis", "glass-caustic", "furnace"}) {
        const Scene scene = loadScene(name);
        const RenderSettings settings = imageSettings(40, 36, 4);
        const RenderResult special = renderScene(device(), scene, settings);
        const RenderResult general = renderScene(device(), scene, settings, [](std::string_view kernel) {
            std::string isGeneral = "true";
            for (const char* kept :
                 {"VertexColors", "Iridescence", "Anisotropy", "Lens", "Panorama", "Orthographic", "Lights",
                  "EnvironmentLight", "EnvironmentMap", "ManyTriangles", "Solids", "StartsVary"})
                isGeneral += std::string(" && (feature) != kFeature") + kept;
            return patchedKernel(kernel, {"lib/features.glsl", "#define sceneHas(feature) (",
                                          "#define sceneHas(feature) (" + isGeneral + " || "});
        });
        EXPECT_EQ(special.filmWords, general.filmWords) << name;
    }
}

TEST_F(Determinism, BandHeightChangesNoBit) {
    const std::vector<uint32_t> expected = filmOf(baseSettings());
    for (const uint32_t rows : {1u, 7u, 36u, 50u}) {
        RenderSettings settings = baseSettings();
        settings.work.bandRows = rows;
        EXPECT_EQ(filmOf(settings), expected) << rows;
    }
}

TEST_F(Determinism, RangesOfSamplesAddUpExactly) {
    RenderSettings settings = baseSettings();
    const std::vector<uint32_t> expected = filmOf(settings);
    settings.stop.samples = 8;
    const std::vector<uint32_t> first = filmOf(settings);
    settings.image.firstSample = 8;
    const std::vector<uint32_t> second = filmOf(settings);
    EXPECT_NE(first, second);
    EXPECT_EQ(sumOfFilms(first, second), expected);
}

// Many samples of few pixels in one wave: lavapipe cuts loops that are too
// long.
TEST_F(Determinism, ManySamplesOfOnePixelAllCount) {
    RenderSettings settings = imageSettings(1, 1, 40000);
    settings.estimator.maxBounces = 0;
    Scene scene;
    scene.cameras.emplace_back();
    scene.materials.emplace_back();
    scene.environment = {0.25f, 0.5f, 2.0f};
    const RenderResult result = renderScene(device(), scene, settings);
    EXPECT_EQ(result.rendering.sampleCounts.front(), 40000u);
    expectEveryPixel(result, scene.environment);
}

// One band of such an image exceeds what lavapipe allows in a storage buffer
// (128 MiB).
TEST_F(Determinism, ImageTooLargeForOneBufferIsWhole) {
    RenderSettings settings = imageSettings(100, 16384, 1);
    settings.estimator.maxBounces = 0;
    Scene scene;
    scene.cameras.emplace_back();
    scene.materials.emplace_back();
    scene.environment = {0.25f, 0.5f, 2.0f};
    expectEveryPixel(renderScene(device(), scene, settings), scene.environment);
}

} // namespace
} // namespace lavalight::test
