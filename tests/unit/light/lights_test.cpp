// All lights of a scene are in one distribution, in the stated order, with the stated probabilities.
#include "light/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.h"

namespace lavalight::test {
namespace {

using std::numbers::pi;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Bounds kBounds = {{-1.0f, -2.0f, -2.0f}, {1.0f, 2.0f, 2.0f}}; // radius 3

PunctualLight punctual(PunctualKind kind, const glm::vec3& intensity) {
    PunctualLight light;
    light.name = "lamp";
    light.kind = kind;
    light.intensity = intensity;
    return light;
}

PunctualLight spot(float inner, float outer) {
    PunctualLight light = punctual(PunctualKind::spot, {1.0f, 2.0f, 6.0f});
    light.innerConeAngle = inner;
    light.outerConeAngle = outer;
    return light;
}

// A right-angled triangle of area 1/2 that emits its front's power of pi / 2 W, and a dark one.
Scene sceneOf(std::vector<PunctualLight> punctuals) {
    Scene scene;
    Material glowing;
    glowing.emission = glm::vec3(1.0f);
    scene.materials = {Material{}, glowing};
    const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.meshes = {{"dark", 0, corners, {}, {{0, 1, 2}}}, {"glowing", 1, corners, {}, {{0, 1, 2}}}};
    scene.punctualLights = std::move(punctuals);
    scene.bounds = kBounds;
    return scene;
}

// Falloff as KHR_lights_punctual states it.
double coneFactor(const PunctualLight& light, double angle) {
    const double inner = std::cos(double{light.innerConeAngle});
    const double outer = std::cos(double{light.outerConeAngle});
    if (inner == outer)
        return std::cos(angle) > outer ? 1.0 : 0.0;
    const double ramp = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
    return ramp * ramp;
}

// The cone factor's integral over the sphere of directions, by midpoints; the steps end at both cone angles.
double integratedConeFactor(const PunctualLight& light) {
    constexpr int kSteps = 20000;
    double sum = 0.0;
    const double edges[] = {0.0, light.innerConeAngle, light.outerConeAngle, pi};
    for (int part = 0; part < 3; ++part) {
        const double step = (edges[part + 1] - edges[part]) / kSteps;
        for (int i = 0; i < kSteps; ++i) {
            const double angle = edges[part] + (i + 0.5) * step;
            sum += 2.0 * pi * std::sin(angle) * coneFactor(light, angle) * step;
        }
    }
    return sum;
}

TEST(LightPower, OfAPointLightIsItsIntensityOverAllDirections) {
    EXPECT_NEAR(powerOf(punctual(PunctualKind::point, {1.0f, 2.0f, 6.0f}), kBounds), 12.0 * pi, 1e-12);
}

// The mean of the window 1 - (d / range)^4 over the distances up to the scene's diameter of 6 m, by
// midpoints.
TEST(LightPower, OfALightWithARangeIsWhatOfItGetsAcrossTheScene) {
    for (const float range : {0.01f, 1.0f, 6.0f, 9.0f, 1e6f}) {
        PunctualLight light = punctual(PunctualKind::point, {1.0f, 2.0f, 6.0f});
        const double endless = powerOf(light, kBounds);
        light.range = range;
        constexpr int kSteps = 100000;
        double mean = 0.0;
        for (int i = 0; i < kSteps; ++i)
            mean += std::max(0.0, 1.0 - std::pow(6.0 * (i + 0.5) / kSteps / range, 4.0)) / kSteps;
        EXPECT_NEAR(powerOf(light, kBounds), endless * mean, 1e-5 * endless) << range;
        EXPECT_GT(powerOf(light, kBounds), 0.0);
    }
}

TEST(LightPower, OfASpotLightIsItsIntensityIntegratedOverItsCone) {
    constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2.0f;
    for (const PunctualLight& light : {spot(0.0f, 0.7853982f), spot(0.2f, 0.8f), spot(0.5f, 0.5f),
                                       spot(0.0f, kQuarterTurn), spot(kQuarterTurn, kQuarterTurn)}) {
        const double expected = 3.0 * integratedConeFactor(light);
        EXPECT_NEAR(powerOf(light, kBounds), expected, 1e-7 * expected) << light.outerConeAngle;
    }
}

TEST(LightPower, OfANarrowSpotLightIsNotLostToRounding) {
    for (const float angle : {1e-3f, 1e-4f, 1e-7f}) { // a disc of the angle's radius, small enough to be flat
        const double disc = 3.0 * pi * double{angle} * angle;
        EXPECT_NEAR(powerOf(spot(angle, angle), kBounds), disc, 1e-6 * disc);
    }
}

TEST(LightPower, OfADirectionalLightIsWhatCrossesTheDiscAroundTheScene) {
    EXPECT_NEAR(powerOf(punctual(PunctualKind::directional, {1.0f, 2.0f, 6.0f}), kBounds), 27.0 * pi, 1e-12);
}

TEST(LightPower, OfTheEnvironmentIsWhatEntersTheSphereAroundTheScene) {
    const double irradiance = pi * 3.0;
    EXPECT_NEAR(environmentPower({1.0f, 2.0f, 6.0f}, kBounds), irradiance * 4.0 * pi * 9.0, 1e-9);
}

TEST(Lights, AreNumberedEmittersThenPunctualsThenEnvironment) {
    const Scene scene = sceneOf({punctual(PunctualKind::point, glm::vec3(1.0f)),
                                 punctual(PunctualKind::directional, glm::vec3(1.0f))});
    const Lights lights = collectLights(scene, glm::vec3(0.5f), LightSelection::power);
    ASSERT_EQ(lights.emitters.list.size(), 1u);
    EXPECT_EQ(lights.emitters.list[0].triangle, 1u);
    EXPECT_EQ(lights.punctuals, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(lights.environment, 3u);
    ASSERT_EQ(lights.powers.size(), 4u);
    EXPECT_NEAR(lights.powers[0], 0.5 * pi, 1e-6);
    EXPECT_EQ(lights.powers[1], powerOf(scene.punctualLights[0], kBounds));
    EXPECT_EQ(lights.powers[2], powerOf(scene.punctualLights[1], kBounds));
    EXPECT_EQ(lights.powers[3], environmentPower(glm::vec3(0.5f), kBounds));
}

TEST(Lights, ArePickedInProportionToTheirPower) {
    const Scene scene = sceneOf({punctual(PunctualKind::point, glm::vec3(0.5f))}); // 2 pi W beside pi / 2
    const Lights lights = collectLights(scene, glm::vec3(0.0f), LightSelection::power);
    ASSERT_EQ(lights.table.size(), 2u);
    EXPECT_NEAR(lights.table[0].pmf, 0.2, 1e-6);
    EXPECT_NEAR(lights.table[1].pmf, 0.8, 1e-6);
}

TEST(Lights, ArePickedAlikeWhenSelectionIsUniform) {
    const Scene scene = sceneOf({punctual(PunctualKind::point, glm::vec3(1000.0f))});
    const Lights lights = collectLights(scene, glm::vec3(0.01f), LightSelection::uniform);
    ASSERT_EQ(lights.table.size(), 3u);
    for (const AliasEntry& entry : lights.table)
        EXPECT_NEAR(entry.pmf, 1.0 / 3.0, 1e-6);
    EXPECT_GT(lights.powers[1], 1000.0); // powers stay what they are
}

TEST(Lights, OfATreeHaveOneColumnTogetherBesideThoseAtInfinity) {
    const Scene scene = sceneOf({punctual(PunctualKind::directional, glm::vec3(1.0f)),
                                 punctual(PunctualKind::point, glm::vec3(1.0f))});
    const Lights lights = collectLights(scene, glm::vec3(0.5f), LightSelection::tree);
    EXPECT_EQ(lights.punctuals,
              (std::vector<uint32_t>{1, 0})); // the point light, which is in the tree, comes first
    EXPECT_EQ(lights.tree.paths.size(), 2u);
    EXPECT_EQ(lights.firstColumn, 2u);
    ASSERT_EQ(lights.table.size(), 3u); // sun, sky, tree
    EXPECT_NEAR(lights.table[0].pmf, 16.0 / 33.0, 1e-6);
    EXPECT_NEAR(lights.table[1].pmf, 1.0 / 33.0, 1e-6);
    EXPECT_NEAR(lights.table[2].pmf, 16.0 / 33.0, 1e-6);
}

TEST(Lights, EnvironmentThatBsdfSamplesDoNotFindIsPickedLikeOthers) {
    const Lights lights = collectLights(sceneOf({}), glm::vec3(0.5f), LightSelection::tree, false);
    ASSERT_EQ(lights.table.size(), 2u);
    EXPECT_NEAR(lights.table[0].pmf, 0.5, 1e-6);
}

TEST(Lights, AllAtInfinityNeedNoTree) {
    Scene scene;
    scene.punctualLights = {punctual(PunctualKind::directional, glm::vec3(1.0f))};
    scene.bounds = kBounds;
    const Lights lights = collectLights(scene, glm::vec3(0.0f), LightSelection::tree);
    EXPECT_TRUE(lights.tree.nodes.empty());
    ASSERT_EQ(lights.table.size(), 1u);
    EXPECT_EQ(lights.table[0].pmf, 1.0f);
}

TEST(LightSelection, IsByTheTreeWhereThereIsAChoice) {
    const auto resolved = [](size_t localLights, size_t allLights) {
        return resolveLightSelection(LightSelection::automatic, localLights, allLights);
    };
    EXPECT_EQ(resolved(0, 0), LightSelection::power);
    EXPECT_EQ(resolved(0, 2), LightSelection::power);
    EXPECT_EQ(resolved(2, 2), LightSelection::power);
    EXPECT_EQ(resolved(1, 2), LightSelection::tree);
    EXPECT_EQ(resolved(3, 3), LightSelection::tree);
    EXPECT_EQ(resolveLightSelection(LightSelection::uniform, 3, 3), LightSelection::uniform);
}

TEST(Lights, WithoutPowerAreLeftOut) {
    for (const LightSelection selection : {LightSelection::power, LightSelection::uniform}) {
        const Scene scene =
            sceneOf({punctual(PunctualKind::point, glm::vec3(0.0f)), spot(0.0f, 0.0f), spot(0.1f, 0.2f)});
        const Lights lights = collectLights(scene, glm::vec3(0.0f), selection);
        EXPECT_EQ(lights.punctuals, (std::vector<uint32_t>{2})); // number of the light in the scene
        EXPECT_EQ(lights.environment, std::nullopt);
        EXPECT_EQ(lights.powers.size(), 2u);
        EXPECT_EQ(lights.table.size(), 2u);
    }
}

TEST(Lights, OfADarkSceneAreNone) {
    const Lights lights = collectLights(Scene{}, glm::vec3(0.0f), LightSelection::uniform);
    EXPECT_TRUE(lights.powers.empty());
    EXPECT_TRUE(lights.table.empty());
}

std::string collectError(const Scene& scene, const glm::vec3& environment, LightSelection selection) {
    try {
        static_cast<void>(collectLights(scene, environment, selection));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(Lights, RefusePowersThatAreNotFiniteAndNameTheLight) {
    for (const LightSelection selection : {LightSelection::power, LightSelection::uniform}) {
        for (const float bad : {kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
            const Scene scene = sceneOf({punctual(PunctualKind::point, {1.0f, bad, 1.0f})});
            EXPECT_NE(collectError(scene, glm::vec3(0.0f), selection).find("light 0 'lamp'"),
                      std::string::npos);
            EXPECT_NE(collectError(sceneOf({}), {bad, 0.0f, 0.0f}, selection).find("the environment"),
                      std::string::npos);
        }
    }
}

} // namespace
} // namespace lavalight::test
