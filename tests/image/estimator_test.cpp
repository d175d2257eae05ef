// Estimators change the noise of an image, never its mean: each setting against the default on a real scene.
#include <string>

#include <gtest/gtest.h>

#include "scene/builtin.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

struct Variant {
    const char* name;
    EstimatorSettings settings;
    uint32_t samples;
};

// The other seed keeps the two images independent, as the Z-test supposes.
EstimatorSettings withOtherSeed() {
    EstimatorSettings settings = imageSettings(1, 1, 1).estimator;
    settings.seed = 1;
    return settings;
}

Variant withMis(const char* name, Mis mis) {
    Variant variant{name, withOtherSeed(), 64};
    variant.settings.mis = mis;
    return variant;
}

Variant withRoulette(const char* name, Roulette roulette, uint32_t start) {
    Variant variant{name, withOtherSeed(), 64};
    variant.settings.roulette = roulette;
    variant.settings.rouletteStart = start;
    return variant;
}

// Finds the light by chance: more samples, or the test would see nothing.
Variant withoutNee() {
    Variant variant{"withoutNee", withOtherSeed(), 256};
    variant.settings.nextEventEstimation = false;
    return variant;
}

Variant withHemisphere(const char* name, Hemisphere hemisphere) {
    Variant variant{name, withOtherSeed(), 128};
    variant.settings.hemisphere = hemisphere;
    return variant;
}

Variant withSelection(const char* name, LightSelection selection) {
    Variant variant{name, withOtherSeed(), 128};
    variant.settings.lightSelection = selection;
    return variant;
}

Variant withSurvivalInMis(const char* name, Roulette roulette) {
    Variant variant = withRoulette(name, roulette, 1);
    variant.settings.misSurvival = true;
    return variant;
}

class Estimator : public DeviceTest, public testing::WithParamInterface<Variant> {
  protected:
    void compareOn(const Scene& scene, const EstimatorSettings& base) {
        RenderSettings settings = imageSettings(48, 48, 64);
        settings.estimator = base;
        const Rendering expected = renderScene(device(), scene, settings).rendering;
        settings.estimator = GetParam().settings;
        settings.estimator.maxBounces = base.maxBounces;
        settings.samples = GetParam().samples;
        const RenderResult result = renderScene(device(), scene, settings);
        EXPECT_EQ(result.tallies.droppedSamples, 0u);
        // Tiles of 256 pixels: sums of 16,384 samples or more are normal enough even where light is found by
        // chance.
        expectSameMean(result.rendering, expected, 16);
        if (HasFailure())
            ADD_FAILURE() << "difference times 10: "
                          << writeDifference(result.rendering.radiance, expected.radiance, 10.0f,
                                             GetParam().name);
    }
};

TEST_P(Estimator, KeepsTheMeanOfTheCornellBox) {
    compareOn(loadScene("cornell-box"), imageSettings(1, 1, 1).estimator);
}

// Metal and glossy dielectric under two lights of unequal size: weights between lobes and light samples
// matter.
TEST_P(Estimator, KeepsTheMeanOfGlossySurfaces) {
    Material floor = lambert({0.6f, 0.5f, 0.4f});
    floor.specular = 1.0f;
    floor.roughness = 0.3f;
    Material metal = lambert({0.9f, 0.7f, 0.5f});
    metal.metallic = 1.0f;
    metal.roughness = 0.4f;
    const Scene scene = SceneBuilder()
                            .add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), floor)
                            .add(ball({0, 1, 0}, 1.0f), metal)
                            .add(rectangle({0, 4, 0}, {1.5f, 0, 0}, {0, 0, 1.5f}), light({3, 3, 4}))
                            .add(rectangle({2, 2, 1}, {0.2f, 0, 0}, {0, 0, 0.2f}), light({20, 10, 5}))
                            .camera(lookAt({2, 3, 5}, {0, 0.5f, 0}, 0.7f))
                            .build();
    compareOn(scene, imageSettings(1, 1, 1).estimator);
}

// Rough glass, a rough thin wall and a rough metal under a small light, a lamp without size and a sky.
TEST_P(Estimator, KeepsTheMeanOfGlassUnderLightsOfEveryKind) {
    Material glass = lambert(glm::vec3(0.9f, 1.0f, 0.95f));
    glass.transmission = 1.0f;
    glass.isSolid = true;
    glass.roughness = 0.3f;
    Material pane = glass;
    pane.isSolid = false;
    pane.transmission = 0.7f;
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), lambert({0.6f, 0.5f, 0.4f}))
                      .add(ball({-0.8f, 1, 0}, 0.9f), glass)
                      .add(rectangle({1.2f, 1, 0}, {0.7f, 0, 0.3f}, {0, 0.9f, 0}), pane)
                      .add(rectangle({0, 4, 0}, {0.7f, 0, 0}, {0, 0, 0.7f}), light({8, 8, 9}))
                      .environment({0.2f, 0.25f, 0.3f})
                      .camera(lookAt({1, 2, 6}, {0, 0.9f, 0}, 0.6f))
                      .build();
    PunctualLight lamp;
    lamp.position = {2.0f, 3.0f, 2.0f};
    lamp.intensity = glm::vec3(4.0f);
    if (GetParam().settings.nextEventEstimation) // nothing else finds a light without size
        scene.punctualLights.push_back(lamp);
    compareOn(scene, imageSettings(1, 1, 1).estimator);
}

INSTANTIATE_TEST_SUITE_P(Variants, Estimator,
                         testing::Values(withMis("balance", Mis::balance),
                                         withMis("lightSamplesOnly", Mis::off),
                                         withRoulette("withoutRoulette", Roulette::off, 3),
                                         withRoulette("earlyRoulette", Roulette::throughput, 1),
                                         withRoulette("constantRoulette", Roulette::constant, 2),
                                         withRoulette("meanAlbedoRoulette", Roulette::meanAlbedo, 1),
                                         withRoulette("maxAlbedoRoulette", Roulette::maxAlbedo, 1),
                                         withSurvivalInMis("constantSurvivalInMis", Roulette::constant),
                                         withSurvivalInMis("meanAlbedoSurvivalInMis", Roulette::meanAlbedo),
                                         withSurvivalInMis("maxAlbedoSurvivalInMis", Roulette::maxAlbedo),
                                         withHemisphere("uniformHemisphere", Hemisphere::uniform),
                                         withSelection("uniformSelection", LightSelection::uniform),
                                         withoutNee()),
                         [](const auto& variant) { return std::string(variant.param.name); });

} // namespace
} // namespace lavalight::test
