// Layers of what camera paths meet first, in every schedule.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "film/film_layout.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSide = 16;
constexpr uint32_t kAll = 1u << kAlbedoPlane | 1u << kNormalPlane | 1u << kDepthPlane | 1u << kPositionPlane |
                          1u << kEmissionPlane | 1u << kGuideAlbedoPlane | 1u << kGuideNormalPlane;
constexpr glm::vec3 kRed(0.7f, 0.2f, 0.1f);
constexpr glm::vec3 kSky(0.3f, 0.4f, 0.5f);

class FirstSurface : public DeviceTest {
  protected:
    [[nodiscard]] Rendering render(const Scene& scene, Schedule schedule, uint32_t layers = kAll,
                                   uint32_t waveSize = 0) {
        RenderSettings settings = imageSettings(kSide, kSide, 8);
        settings.work.schedule = schedule;
        settings.work.waveSize = waveSize;
        settings.layers = layers;
        return renderScene(device(), scene, settings).rendering;
    }
    // Renders the scene in every schedule, and lets `check` see each image.
    template <typename Check>
    void inEverySchedule(const SceneBuilder& scene, const Check& check) {
        for (const Schedule schedule : schedulesOf(device())) {
            SCOPED_TRACE(static_cast<int>(schedule));
            check(render(scene.build(), schedule));
        }
    }
    [[nodiscard]] static glm::vec3 at(const Rendering& image, const std::string& layer, uint32_t x,
                                      uint32_t y) {
        const Layer* found = image.find(layer);
        EXPECT_NE(found, nullptr) << layer;
        return found != nullptr ? found->mean.at(x, y) : glm::vec3(NAN);
    }
    static void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
        EXPECT_NEAR(glm::length(a - b), 0.0f, tolerance) << a.x << " " << a.y << " " << a.z;
    }
};

// Scenes under the sky, seen without perspective from z = 5.
SceneBuilder seenFromAbove(float halfHeight) {
    return SceneBuilder().environment(kSky).camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, halfHeight));
}

// A box of side 1 in a view of 2 m by 2 m.
TEST_F(FirstSurface, LayersOfABoxAreItsOwnAndThoseOfTheSkyAreNone) {
    inEverySchedule(
        seenFromAbove(1.0f).add(cube({0, 0, 0}, 0.5f), lambert(kRed)), [](const Rendering& image) {
            constexpr uint32_t kX = 6; // x from -0.25 to -0.125
            constexpr uint32_t kY = 9;
            expectNear(at(image, "albedo", kX, kY), kRed);
            expectNear(at(image, "guide-albedo", kX, kY), kRed);
            expectNear(at(image, "normal", kX, kY), {0, 0, 1});
            expectNear(at(image, "guide-normal", kX, kY), {0, 0, 1});
            EXPECT_NEAR(at(image, "depth", kX, kY).x, 4.5f, 1e-5f);
            expectNear(at(image, "position", kX, kY), {-0.1875f, -0.1875f, 0.5f}, 0.03f);
            EXPECT_EQ(at(image, "hits", kX, kY).x, 1.0f);
            expectNear(at(image, "emission", kX, kY), glm::vec3(0.0f));
            for (const char* layer :
                 {"albedo", "normal", "depth", "position", "hits", "guide-albedo", "guide-normal"})
                EXPECT_EQ(at(image, layer, 0, 0), glm::vec3(0.0f)) << layer;
            expectNear(at(image, "emission", 0, 0), kSky);
        });
}

// Depth, normal and position are means over what is hit; the others over all samples.
TEST_F(FirstSurface, APixelThatIsHalfSkyHasTheWholeDepthOfTheOtherHalf) {
    const Shape half = rectangle({-10 + 1.0f / kSide, 0, 0}, {10, 0, 0}, {0, 10, 0});
    inEverySchedule(seenFromAbove(1.0f).add(half, lambert(kRed)), [](const Rendering& image) {
        constexpr uint32_t kEdge = kSide / 2;
        const float hits = at(image, "hits", kEdge, 3).x;
        EXPECT_NEAR(hits, 0.5f, 0.15f);
        EXPECT_NEAR(at(image, "depth", kEdge, 3).x, 5.0f, 1e-5f);
        expectNear(at(image, "normal", kEdge, 3), {0, 0, 1});
        expectNear(at(image, "albedo", kEdge, 3), hits * kRed);
        expectNear(at(image, "emission", kEdge, 3), (1.0f - hits) * kSky);
    });
}

// A mirror at 45 degrees shows a red wall at its right, which faces -x.
TEST_F(FirstSurface, GuidesGoThroughMirrorsAndTheLayersDoNot) {
    Material mirror;
    mirror.metallic = 1.0f;
    mirror.roughness = 0.0f;
    const glm::vec3 across = glm::normalize(glm::vec3(1, 0, -1));
    const SceneBuilder scene = seenFromAbove(0.5f)
                                   .add(rectangle({0, 0, 0}, 3.0f * across, {0, 3, 0}), mirror)
                                   .add(rectangle({6, 0, 0}, {0, 0, 9}, {0, 9, 0}), lambert(kRed));
    inEverySchedule(scene, [](const Rendering& image) {
        expectNear(at(image, "normal", 8, 8), glm::normalize(glm::vec3(1, 0, 1)));
        expectNear(at(image, "albedo", 8, 8), glm::vec3(1.0f), 1e-3f);
        expectNear(at(image, "guide-albedo", 8, 8), kRed, 1e-3f);
        expectNear(at(image, "guide-normal", 8, 8), {-1, 0, 0});
    });
}

TEST_F(FirstSurface, AlbedoIsThereWithoutScattering) {
    const Scene scene = seenFromAbove(1.0f).add(cube({0, 0, 0}, 0.5f), lambert(kRed)).build();
    for (const Schedule schedule : schedulesOf(device())) {
        RenderSettings settings = imageSettings(kSide, kSide, 2);
        settings.work.schedule = schedule;
        settings.layers = 1u << kAlbedoPlane;
        settings.estimator.maxBounces = 0;
        const Rendering image = renderScene(device(), scene, settings).rendering;
        expectNear(at(image, "albedo", 8, 8), kRed);
        EXPECT_EQ(image.radiance().at(8, 8), glm::vec3(0.0f));
    }
}

TEST_F(FirstSurface, LightThatIsSeenIsItsRadianceAndColourIsWhatItWasWithoutLayers) {
    const Scene scene = SceneBuilder()
                            .add(rectangle({-0.5f, 0, 0}, {0.5f, 0, 0}, {0, 2, 0}), light({7, 5, 3}))
                            .add(rectangle({0.5f, 0, 0}, {0.5f, 0, 0}, {0, 2, 0}), lambert(kRed))
                            .add(rectangle({0, 3, 2}, {1, 0, 0}, {0, 0, 1}), light(glm::vec3(4.0f)))
                            .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
                            .build();
    for (const Schedule schedule : schedulesOf(device())) {
        SCOPED_TRACE(static_cast<int>(schedule));
        const Rendering image = render(scene, schedule);
        EXPECT_EQ(at(image, "emission", 2, 5), glm::vec3(7, 5, 3));
        EXPECT_EQ(at(image, "emission", 13, 5), glm::vec3(0.0f));
        EXPECT_EQ(image.radiance().pixels, render(scene, schedule, 0).radiance().pixels);
        const Rendering inSmallWaves = render(scene, schedule, kAll, 512);
        for (size_t i = 0; i < image.layers.size(); ++i)
            EXPECT_EQ(image.layers[i].mean.pixels, inSmallWaves.layers[i].mean.pixels)
                << image.layers[i].name;
    }
}

} // namespace
} // namespace lavalight::test
