// Images lit by environment maps: closed forms, orientation, and estimators that agree under a sun.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "support/environment_maps.h"
#include "support/estimator_variants.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

Scene withMap(Scene scene, Image map) {
    scene.environmentMap = {"test", std::move(map)};
    return scene;
}

class EnvironmentImage : public DeviceTest {};

TEST_F(EnvironmentImage, WhiteBallUnderAWhiteMapIsInvisible) {
    const Scene scene = withMap(SceneBuilder()
                                    .add(ball(glm::vec3(0.0f), 1.0f), lambert(glm::vec3(1.0f)))
                                    .camera(lookAt({1.5f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.6f))
                                    .build(),
                                constantMap(64, 32, glm::vec3(1.0f)));
    RenderSettings settings = imageSettings(32, 32, 256);
    settings.estimator.roulette = Roulette::off;
    expectMean(renderScene(device(), scene, settings), glm::dvec3(1.0), 0.002);
}

// A large sun, which BSDF rays find too. The floor has E = pi L + (2 pi (1 - c)) (1 + c) / 2 S cos, for a
// disc that is above the horizon as a whole.
TEST_F(EnvironmentImage, FloorUnderASunDiscReflectsMapAndDiscWithEveryEstimator) {
    constexpr double kPi = 3.14159265358979;
    Scene scene = withMap(SceneBuilder()
                              .add(rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), lambert(glm::vec3(0.5f)))
                              .camera(lookAtOrthographic({0.1f, 3, 0.1f}, {0, 0, 0}, 0.3f))
                              .build(),
                          constantMap(64, 32, glm::vec3(0.2f)));
    const double cosine = std::cos(0.2);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.5f, 0.8f, -0.3f));
    const glm::vec3 radiance(9.0f, 6.0f, 3.0f);
    scene.environmentMap->sun = {direction, radiance, static_cast<float>(1.0 - cosine)};
    const double discFactor = kPi * (1.0 - cosine * cosine) * direction.y;
    const glm::dvec3 expected = 0.5 / kPi * (glm::dvec3(0.2 * kPi) + discFactor * glm::dvec3(radiance));
    for (const Schedule schedule : schedulesOf(device()))
        for (const bool nee : {true, false})
            for (const Mis mis : {Mis::power, Mis::balance, Mis::off}) {
                if (!nee && mis != Mis::power)
                    continue;
                SCOPED_TRACE(static_cast<int>(schedule) * 100 + static_cast<int>(mis) * 10 + (nee ? 1 : 0));
                RenderSettings settings = imageSettings(16, 16, nee ? 256 : 4096);
                settings.work.schedule = schedule;
                settings.estimator.nextEventEstimation = nee;
                settings.estimator.mis = mis;
                expectMean(renderScene(device(), scene, settings), expected, 0.01);
            }
}

// Where the map turns, so does its sun.
TEST_F(EnvironmentImage, CameraSeesTheSunDiscTurnedWithItsMap) {
    Scene scene = withMap(SceneBuilder()
                              .add(rectangle({-1, 0, 0}, {0, 0, 1}, {0, 1, 0}), lambert(glm::vec3(0.0f)))
                              .camera(lookAt({0, 0, 0}, {0.8f, 0.6f, 0}, 0.1f))
                              .build(),
                          constantMap(16, 8, glm::vec3(0.25f)));
    scene.environmentMap->sun = {{0.0f, 0.6f, 0.8f}, glm::vec3(100.0f), 0.01f};
    RenderSettings settings = imageSettings(4, 4, 2);
    expectEveryPixel(renderScene(device(), scene, settings), glm::dvec3(0.25));
    settings.lighting.rotation = 90.0f; // counter-clockwise from above: +Z comes to +X
    expectEveryPixel(renderScene(device(), scene, settings), glm::dvec3(100.25));
}

// The bits, too: films of both merge.
TEST_F(EnvironmentImage, ARestartTurnsTheSunToWhereANewRenderHasIt) {
    Scene scene = withMap(SceneBuilder()
                              .add(rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), lambert(glm::vec3(0.5f)))
                              .camera(lookAt({0, 1, 0.1f}, {0, 0, 0}, 0.1f))
                              .build(),
                          constantMap(16, 8, glm::vec3(0.25f)));
    scene.environmentMap->sun = {glm::normalize(glm::vec3(0.3f, 0.6f, 0.8f)), glm::vec3(100.0f), 0.01f};
    RenderSettings settings = imageSettings(4, 4, 1);
    Renderer renderer(device(), scene, scene.cameras.front(), settings);
    for (const float rotation : {33.0f, -71.0f, 12.5f}) {
        settings.lighting.rotation = rotation;
        renderer.restart(scene, scene.cameras.front(), settings, embeddedKernel);
    }
    const Renderer fresh(device(), scene, scene.cameras.front(), settings);
    EXPECT_EQ(renderer.frame().sunDirection, fresh.frame().sunDirection);
    EXPECT_NE(renderer.frame().sunDirection, scene.environmentMap->sun->direction);
}

// Each quarter of the map has a colour of its own.
TEST_F(EnvironmentImage, CameraSeesTheMapTurnedAndScaled) {
    Image map(4, 1);
    map.pixels = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    const Camera towardsX = lookAt({0, 0, 0}, {1, 0, 0}, 0.2f);
    const Scene scene =
        withMap(SceneBuilder()
                    .add(rectangle({-1, 0, 0}, {0, 0, 1}, {0, 1, 0}), lambert(glm::vec3(0.0f)))
                    .camera(towardsX)
                    .build(),
                map);
    RenderSettings settings = imageSettings(8, 8, 4);
    // Along +X, half-way between the second and the third texel.
    const ImageMean ahead = meanOf(renderScene(device(), scene, settings).rendering);
    EXPECT_NEAR(ahead.mean.g, 0.5, 0.02);
    EXPECT_NEAR(ahead.mean.b, 0.5, 0.02);
    // Turned by an eighth counter-clockwise, +X shows what was towards +Z: the third texel.
    settings.lighting.rotation = 45.0f;
    settings.lighting.intensity = 3.0f;
    const ImageMean turned = meanOf(renderScene(device(), scene, settings).rendering);
    EXPECT_NEAR(turned.mean.b, 3.0, 0.3);
    EXPECT_LT(turned.mean.r, 0.1);
}

// The sun's texel reaches into its neighbours; the floor has the irradiance of all of it.
TEST_F(EnvironmentImage, FloorUnderASunReflectsItsIrradiance) {
    constexpr double kPi = 3.14159265358979;
    const Image map = sunMap(64, 32, {20, 12}, 1000.0f, 0.0f);
    const Scene scene = withMap(SceneBuilder()
                                    .add(rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), lambert(glm::vec3(0.5f)))
                                    .camera(lookAtOrthographic({0.1f, 3, 0.1f}, {0, 0, 0}, 0.3f))
                                    .build(),
                                map);
    double irradiance = 0.0;
    constexpr size_t kSteps = 2048;
    for (size_t y = 0; y < kSteps / 2; ++y)
        for (size_t x = 0; x < kSteps; ++x) {
            const glm::dvec2 uv((x + 0.5) / kSteps, (y + 0.5) / kSteps);
            irradiance += mapLookup(map, uv).x * std::sin(kPi * uv.y) * std::cos(kPi * uv.y) *
                          (2.0 * kPi * kPi / (double{kSteps} * kSteps));
        }
    expectMean(renderScene(device(), scene, imageSettings(16, 16, 64)), glm::dvec3(0.5 / kPi * irradiance),
               0.005);
}

// A sun behind a panel's edge, metal and gloss: what light samples and BSDF samples find must add up.
Scene sunnyScene() {
    Material floor = lambert({0.6f, 0.5f, 0.4f});
    floor.specular = 1.0f;
    floor.roughness = 0.4f;
    Material metal = lambert({0.9f, 0.7f, 0.5f});
    metal.metallic = 1.0f;
    metal.roughness = 0.5f;
    return withMap(SceneBuilder()
                       .add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), floor)
                       .add(ball({0, 1, 0}, 1.0f), metal)
                       .add(rectangle({2, 2, 1}, {0.2f, 0, 0}, {0, 0, 0.2f}), light({20, 10, 5}))
                       .camera(lookAt({2, 3, 5}, {0, 0.5f, 0}, 0.7f))
                       .build(),
                   sunMap(16, 8, {10, 2}, 20.0f, 0.3f));
}

TEST_F(EnvironmentImage, EverySettingHasTheMeanOfTheDefaultUnderASun) {
    // With fewer samples, BSDF rays alone find the sun too seldom for their variance to be known.
    expectOneMean(device(), sunnyScene(), singleVariants(), {512, 0.3});
}

} // namespace
} // namespace lavalight::test
