// A film does not depend on who built the tree over the scene's triangles.
#include "support/other_trees.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "device_scene/scene_features.h"
#include "render/film.h"
#include "render/renderer.h"
#include "render/schedule_choice.h"
#include "render/setting_names.h"
#include "support/patched_kernel.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSize = 48;

Material colored(const glm::vec3& color, float alpha = 1.0f) {
    Material material = lambert(color);
    material.alphaMode = alpha < 1.0f ? AlphaMode::blend : AlphaMode::opaque;
    material.alpha = alpha;
    return material;
}

// A grid of `cells` x `cells` squares. Neighbours share their corners.
Shape grid(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, uint32_t cells) {
    Shape shape;
    for (uint32_t y = 0; y <= cells; ++y)
        for (uint32_t x = 0; x <= cells; ++x)
            shape.positions.push_back(corner + static_cast<float>(x) / static_cast<float>(cells) * u +
                                      static_cast<float>(y) / static_cast<float>(cells) * v);
    for (uint32_t y = 0; y < cells; ++y)
        for (uint32_t x = 0; x < cells; ++x) {
            const uint32_t first = y * (cells + 1) + x;
            shape.triangles.emplace_back(first, first + 1, first + cells + 1);
            shape.triangles.emplace_back(first + 1, first + cells + 2, first + cells + 1);
        }
    return shape;
}

// The shape with its triangles in reverse order.
Shape backwards(Shape shape) {
    std::reverse(shape.triangles.begin(), shape.triangles.end());
    return shape;
}

// A room whose floor, wall and ball lie two or three times in one place. Copies differ in colour and in the
// order of their triangles, and alpha lets some rays through; triangles share edges.
Scene crowdedRoom() {
    const Shape floor = grid({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 13);
    const Shape wall = grid({-2, 0, -2}, {4, 0, 0}, {0, 4, 0}, 7);
    const Shape body = ball({0.3f, 0.8f, 0}, 0.8f);
    SceneBuilder builder;
    builder.add(floor, colored({0.8f, 0.3f, 0.3f}, 0.5f));
    builder.add(backwards(floor), colored({0.3f, 0.8f, 0.3f}));
    builder.add(floor, colored({0.3f, 0.3f, 0.8f}));
    builder.add(wall, colored({0.7f, 0.7f, 0.2f}));
    builder.add(backwards(wall), colored({0.2f, 0.7f, 0.7f}, 0.5f));
    builder.add(backwards(body), colored({0.9f, 0.9f, 0.9f}, 0.3f));
    builder.add(body, colored({0.7f, 0.2f, 0.7f}, 0.6f));
    builder.add(rectangle({0, 3.9f, 0}, {0.7f, 0, 0}, {0, 0, 0.7f}), light(glm::vec3(8.0f)));
    builder.add(rectangle({0, 3.9f, 0}, {0.7f, 0, 0}, {0, 0, 0.7f}), light(glm::vec3(2.0f, 8.0f, 2.0f)));
    return builder.environment(glm::vec3(0.3f)).camera(lookAt({1, 2.5f, 4}, {0, 1, 0}, 0.9f)).build();
}

class OtherTrees : public DeviceTest {
  protected:
    void prepare(Schedule schedule, const KernelSource& source = embeddedKernel) {
        settings_ = imageSettings(kSize, kSize, 16);
        settings_.work.schedule = schedule;
        settings_ = resolveSchedule(settings_, device().description());
        settings_.work.waveSize = kSize * kSize * settings_.stop.samples;
        kernels_.emplace(device(), kernelVariants(phasesOf(settings_), schedule, classes_),
                         settings_.estimator, features_, filmPlanes(settings_), source);
    }
    [[nodiscard]] std::vector<uint32_t> filmWith(const Bvh& tree) {
        SceneData data = packScene(scene_, lights_);
        data.accelerator.bvh = tree;
        const GpuScene gpuScene(device(), data);
        FrameParameters frame = makeFrame(scene_, scene_.cameras.front(), settings_);
        setLights(frame, lights_);
        const gpu::Buffer noLayers(device(), "no layers of triangles", 0, gpu::BufferUse::storage);
        Film film(device(), kSize, kSize, 0);
        film.clear();
        const auto kernel = [&](std::string_view name) -> const gpu::Kernel& { return (*kernels_)[name]; };
        const std::vector<Phase> phases = phasesOf(settings_);
        WaveRange range{};
        range.pixelCount = kSize * kSize;
        range.sampleCount = settings_.stop.samples;
        makeWaveRenderer(device(), {phases, settings_.work.schedule, gpuScene, gpuScene.albedoTable().buffer,
                                    noLayers, film, frame, kernel, classes_, features_})
            ->renderWave(kPathTransport, 0, range);
        return film.bands().front().sums.downloadAll<uint32_t>();
    }

    // Beside our own tree.
    [[nodiscard]] double shareThatRayQueriesChange(const Scene& scene, Schedule schedule) {
        RenderSettings settings = imageSettings(kSize, kSize, 16);
        settings.work = {.schedule = schedule, .accelerator = RayAccelerator::bvh8};
        const Rendering ours = renderScene(device(), scene, settings).rendering;
        settings.work.accelerator = RayAccelerator::rayQuery;
        return shareThatDiffers(ours, renderScene(device(), scene, settings).rendering);
    }

    const Scene scene_ = crowdedRoom();
    const Lights lights_ = collectLights(scene_, scene_.environment, LightSelection::power);
    const std::vector<Triangle> triangles_ = sceneTriangles(scene_);

  private:
    const MaterialClasses classes_ = materialClasses(scene_);
    const SceneFeatures features_ = sceneFeatures(scene_, lights_) | cameraFeatures(scene_.cameras.front());
    RenderSettings settings_;
    std::optional<EstimatorKernels> kernels_;
};

TEST_F(OtherTrees, GiveTheSameFilm) {
    const Bvh embree = buildBvh(triangles_);
    for (const Schedule schedule : {Schedule::fused, Schedule::wavefront}) {
        prepare(schedule);
        const std::vector<uint32_t> film = filmWith(embree);
        EXPECT_EQ(filmWith(medianBvh(triangles_)), film);
        EXPECT_EQ(filmWith(withLeavesReversed(embree)), film);
        EXPECT_EQ(filmWith(buildBvh(triangles_, {.triangleCost = 1.0f, .splitBudget = 2.0f})), film);
    }
}

TEST_F(OtherTrees, TheHostsAmongThemGiveTheSamePicture) {
    if (!device().description().sharesMemory)
        GTEST_SKIP() << "the host does not reach the device's memory";
    RenderSettings settings = imageSettings(kSize, kSize, 16);
    settings.work.schedule = Schedule::fused;
    const Rendering kernels = renderScene(device(), scene_, settings).rendering;
    for (const RayAccelerator accelerator : {RayAccelerator::bvh16, RayAccelerator::embree}) {
        settings.work = {.schedule = Schedule::hosted, .accelerator = accelerator};
        EXPECT_LE(shareThatDiffers(kernels, renderScene(device(), scene_, settings).rendering), 0.01)
            << nameOf(accelerator);
    }
}

TEST_F(OtherTrees, TheDevicesAmongThemGiveTheSamePicture) {
    if (!device().tracesRays())
        GTEST_SKIP() << "the device has no VK_KHR_ray_query";
    for (const Schedule schedule : {Schedule::fused, Schedule::wavefront})
        EXPECT_LE(shareThatRayQueriesChange(scene_, schedule), 0.01);
}

// Triangles far larger than their distance from the world's origin and from the camera: what rounds is their
// size.
TEST_F(OtherTrees, TheDevicesFindLargeTrianglesThatCoincide) {
    if (!device().tracesRays())
        GTEST_SKIP() << "the device has no VK_KHR_ray_query";
    SceneBuilder builder;
    for (const glm::vec3& color : {glm::vec3(0.8f, 0.1f, 0.1f), glm::vec3(0.1f, 0.8f, 0.1f)})
        builder.add(rectangle({0, 0, 0}, {1.1f, 0.1f, 0}, {-0.1f, 1.0f, 0}), colored(color));
    builder.environment(glm::vec3(1.0f)).camera(lookAt({0, 0.002f, 0.002f}, {0, 0, 0}, 0.9f));
    EXPECT_LE(shareThatRayQueriesChange(builder.build(), Schedule::fused), 0.001);
}

// Embree traces camera rays together: waves put other rays beside each, here where alpha, back faces and
// coincident surfaces answer for each ray by itself.
TEST_F(OtherTrees, WavesOfTheHostGiveTheSameFilm) {
    if (!device().description().sharesMemory)
        GTEST_SKIP() << "the host does not reach the device's memory";
    RenderSettings settings = imageSettings(kSize, kSize, 3);
    for (const RayAccelerator accelerator : {RayAccelerator::bvh16, RayAccelerator::embree}) {
        settings.work = {.schedule = Schedule::hosted, .accelerator = accelerator};
        const std::vector<uint32_t> film = renderScene(device(), scene_, settings).filmWords;
        for (const uint32_t waveSize : {65u, 1001u}) {
            settings.work.waveSize = waveSize;
            EXPECT_EQ(renderScene(device(), scene_, settings).filmWords, film)
                << nameOf(accelerator) << " " << waveSize;
        }
    }
}

// By the rule for triangles at equal distance, and not because there are none.
TEST_F(OtherTrees, GiveOtherFilmsWhereTheFirstTriangleMetWins) {
    prepare(Schedule::fused, [](std::string_view kernel) {
        return patchedKernel(kernel,
                             {"scene/intersect.glsl", " || (t == otherT && precedes(surface, other))", ""});
    });
    const Bvh embree = buildBvh(triangles_);
    const std::vector<uint32_t> film = filmWith(embree);
    EXPECT_NE(filmWith(medianBvh(triangles_)), film);
    EXPECT_NE(filmWith(withLeavesReversed(embree)), film);
}

} // namespace
} // namespace lavalight::test
