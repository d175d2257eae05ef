// Layers of light, coordinates, motion and ids, in every schedule.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "film/film_layout.h"
#include "film/raw_film.h"
#include "render/renderer.h"
#include "session/next_frame.h"
#include "support/patched_kernel.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSide = 16;
constexpr uint32_t kLight = 1u << kDirectPlane | 1u << kIndirectPlane;

class LightLayers : public DeviceTest {
  protected:
    [[nodiscard]] RenderSettings settings(Schedule schedule, uint32_t layers, uint32_t samples = 16) const {
        RenderSettings settings = imageSettings(kSide, kSide, samples);
        settings.work.schedule = schedule;
        settings.layers = layers;
        return settings;
    }
    [[nodiscard]] RawFilm film(const Scene& scene, const RenderSettings& settings,
                               const KernelSource& kernels = embeddedKernel) {
        Renderer renderer(device(), scene, scene.cameras.front(), settings, kernels);
        renderer.render([](double) { return true; });
        return renderer.film().read();
    }
};

// The words of a sum of a film, from the lowest.
std::vector<uint32_t> sumOf(const RawFilm& film, uint32_t plane, uint32_t component, size_t pixel) {
    const size_t index = film.layout.find(plane).value();
    const FilmPlane& shape = film.layout.planes()[index].shape;
    const uint32_t first = film.layout.firstWord(index) + component * componentWordsOf(shape);
    std::vector<uint32_t> sum;
    for (uint32_t word = 0; word < sumWordsOf(shape); ++word)
        sum.push_back(film.words[(first + word) * film.pixels() + pixel]);
    return sum;
}

std::vector<uint32_t> added(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
    std::vector<uint32_t> sum;
    uint64_t carry = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        carry += uint64_t{a[i]} + b[i];
        sum.push_back(static_cast<uint32_t>(carry));
        carry >>= 32;
    }
    return sum;
}

// Glass, metal, a lamp in sight and one behind a corner.
Scene mixedRoom() {
    Material glass = lambert(glm::vec3(1.0f));
    glass.specular = 1.0f;
    glass.transmission = 1.0f;
    glass.roughness = 0.0f;
    glass.isSolid = true;
    Material metal;
    metal.roughness = 0.3f;
    return SceneBuilder()
        .add(insideOut(cube({0, 0, 0}, 2.0f)), lambert({0.7f, 0.5f, 0.3f}))
        .add(rectangle({0, 1.9f, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}), light({9, 8, 7}))
        .add(ball({-0.7f, -1.0f, 0}, 0.7f), glass)
        .add(ball({0.8f, -1.0f, 0.3f}, 0.6f), metal)
        .camera(lookAt({0, 0, 1.9f}, {0, -0.2f, 0}, 1.4f))
        .build();
}

TEST_F(LightLayers, DirectAndIndirectAddUpToTheColourInTheFilmsIntegers) {
    const Scene scene = mixedRoom();
    const std::vector<Schedule> schedules = schedulesOf(device());
    for (const Schedule schedule : schedules)
        for (const PixelFilter filter : {PixelFilter::box, PixelFilter::mitchell}) {
            if (schedule != schedules.front() && filter == PixelFilter::mitchell)
                continue;
            SCOPED_TRACE(static_cast<int>(schedule) * 10 + static_cast<int>(filter));
            RenderSettings wanted = settings(schedule, kLight);
            wanted.estimator.pixelFilter = filter;
            wanted.estimator.clampIndirect = 2.0f;
            const RawFilm film = this->film(scene, wanted);
            uint32_t unequal = 0;
            for (size_t pixel = 0; pixel < film.pixels(); ++pixel)
                for (uint32_t c = 0; c < 3; ++c)
                    unequal +=
                        sumOf(film, kColorPlane, c, pixel) == added(sumOf(film, kDirectPlane, c, pixel),
                                                                    sumOf(film, kIndirectPlane, c, pixel))
                            ? 0
                            : 1;
            EXPECT_EQ(unequal, 0u);
            EXPECT_EQ(film.tallies[kTallyNegative], 0u);
        }
}

// With one bounce at most there is nothing but direct light, with the same random numbers.
TEST_F(LightLayers, DirectLightIsTheRenderOfOneBounce) {
    const Scene scene = mixedRoom();
    for (const Schedule schedule : schedulesOf(device()))
        for (const bool samplesLights : {true, false}) {
            if (schedule != schedulesOf(device()).front() && !samplesLights)
                continue;
            SCOPED_TRACE(static_cast<int>(schedule));
            RenderSettings wanted = settings(schedule, kLight);
            wanted.estimator.roulette = Roulette::off;
            wanted.estimator.nextEventEstimation = samplesLights;
            const Rendering all = renderScene(device(), scene, wanted).rendering;
            wanted.estimator.maxBounces = 1;
            const Rendering one = renderScene(device(), scene, wanted).rendering;
            const Layer* direct = all.find("direct");
            ASSERT_NE(direct, nullptr);
            uint32_t differing = 0;
            for (size_t i = 0; i < direct->mean.pixels.size(); ++i)
                differing += glm::length(direct->mean.pixels[i] - one.radiance().pixels[i]) > 1e-5f ? 1 : 0;
            EXPECT_EQ(differing, 0u);
            EXPECT_GT(glm::length(meanOf(all).mean - meanOf(one).mean), 0.1) << "shows nothing";
            EXPECT_TRUE(all.find("indirect")->variance.has_value());
        }
}

// A wall of 2 m by 2 m that fills the image, with coordinates from 0 to 1.
Scene wallWithCoordinates() {
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), lambert(glm::vec3(0.5f)))
                      .environment(glm::vec3(1.0f))
                      .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
                      .build();
    for (Mesh& mesh : scene.meshes) {
        std::vector<glm::vec2> uvs;
        for (const glm::vec3& p : mesh.positions)
            uvs.emplace_back(0.5f + 0.5f * p.x, 0.5f - 0.5f * p.y);
        mesh.uvs = {uvs};
    }
    return scene;
}

// The wall moves by 1/4 m to the right and 1/8 m up, of 2 m that 16 pixels show: 2 pixels and -1. The sink of
// all schedules finds coordinates and motion.
TEST_F(LightLayers, CoordinatesAreThoseOfTheFileAndMotionLeadsToTheNextFrame) {
    Scene scene = wallWithCoordinates();
    Scene next = scene;
    for (glm::vec3& position : next.meshes.front().positions)
        position += glm::vec3(0.25f, 0.125f, 0.0f);
    scene.next = nextFrameOf(scene, next, next.cameras.front());
    const Rendering image =
        renderScene(device(), scene,
                    settings(schedulesOf(device()).front(), 1u << kUvPlane | 1u << kMotionPlane))
            .rendering;
    for (uint32_t i = 0; i < kSide; ++i) {
        const glm::vec3 uv = image.find("uv")->mean.at(i, 3);
        EXPECT_NEAR(uv.x, (i + 0.5f) / kSide, 0.3f / kSide);
        EXPECT_NEAR(uv.y, 3.5f / kSide, 0.3f / kSide);
    }
    const glm::vec3 motion = image.find("motion")->mean.at(5, 9);
    EXPECT_NEAR(motion.x, 2.0f, 1e-4f);
    EXPECT_NEAR(motion.y, -1.0f, 1e-4f);
}

// A camera with perspective moves 0.5 m to the right past a wall 4 m away: all of it moves left.
TEST_F(LightLayers, AMovingCameraMovesWhatStands) {
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {9, 0, 0}, {0, 9, 0}), lambert(glm::vec3(0.5f)))
                      .environment(glm::vec3(1.0f))
                      .camera(lookAt({0, 0, 4}, {0, 0, 0}, 2.0f * std::atan(0.5f)))
                      .build();
    Camera moved = scene.cameras.front();
    moved.position.x += 0.5f;
    scene.next = nextFrameOf(scene, scene, moved);
    const Rendering image =
        renderScene(device(), scene, settings(schedulesOf(device()).front(), 1u << kMotionPlane)).rendering;
    for (const auto& [x, y] : {std::pair{2u, 3u}, std::pair{12u, 9u}}) {
        const glm::vec3 motion = image.find("motion")->mean.at(x, y);
        EXPECT_NEAR(motion.x, -0.5f / 4.0f * kSide, 1e-4f); // 4 m are kSide pixels
        EXPECT_NEAR(motion.y, 0.0f, 1e-4f);
    }
}

// The left half shows object 2, the right half object 1 behind it; the middle column both.
TEST_F(LightLayers, IdsAreCountedForEachPixel) {
    Scene scene =
        SceneBuilder()
            .add(rectangle({0, 0, -50}, {1, 0, 0}, {0, 1, 0}), lambert(glm::vec3(0.1f)))
            .add(rectangle({-10 + 1.0f / kSide, 0, 0}, {10, 0, 0}, {0, 10, 0}), lambert(glm::vec3(0.5f)))
            .environment(glm::vec3(1.0f))
            .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
            .build();
    scene.meshes[0].object = 0;
    scene.meshes[1].object = 1;
    const auto only = [](uint32_t id) { return std::vector<IdCount>{{id, 16}}; };
    for (const Schedule schedule : schedulesOf(device()))
        for (const uint32_t waveSize : {0u, 256u}) {
            SCOPED_TRACE(static_cast<int>(schedule));
            RenderSettings wanted = settings(schedule, kObjectIds | kMaterialIds);
            wanted.work.waveSize = waveSize;
            const RawFilm film = this->film(scene, wanted);
            ASSERT_EQ(film.ids.size(), 2u);
            for (const IdLayer& layer : film.ids) {
                const size_t row = 3 * kSide;
                EXPECT_EQ(layer.counts.ranked(row + 2), only(2));
                EXPECT_EQ(layer.counts.ranked(row + kSide - 2), only(1));
                const std::vector<IdCount> edge = layer.counts.ranked(row + kSide / 2);
                ASSERT_EQ(edge.size(), 2u);
                EXPECT_EQ(edge[0].count + edge[1].count, 16u);
                EXPECT_NEAR(edge[0].count, 8.0, 2.0);
            }
        }
}

// A sample that is in no plane is in no count of ids: shares of ids are of the samples that there are.
TEST_F(LightLayers, IdsOfDroppedSamplesAreNotCounted) {
    const auto breakPaths = [](std::string_view kernel) {
        return patchedKernel(kernel, {"scene/path_vertex.glsl", "path.throughput *= next.weight;",
                                      "path.throughput *= uintBitsToFloat(0x7fc00000u);"});
    };
    const RawFilm film =
        this->film(wallWithCoordinates(), settings(schedulesOf(device()).front(), kObjectIds, 4), breakPaths);
    EXPECT_EQ(film.tallies[kTallyDropped], 4u * kSide * kSide);
    EXPECT_EQ(film.ids.at(0).counts.deepest(), 0u);
}

} // namespace
} // namespace lavalight::test
