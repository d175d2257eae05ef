// The distribution over an environment map is what its quads do, and has no holes where there is light.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "light/environment.h"
#include "light/lights.h"
#include "support/environment_maps.h"

namespace lavalight::test {
namespace {

using std::numbers::pi;

// Sum over all cells of the density's mean times the solid angle.
double totalProbability(const Image& map, const EnvironmentDistribution& distribution) {
    double sum = 0.0;
    for (uint32_t y = 0; y <= map.height; ++y)
        for (uint32_t x = 0; x < map.width; ++x) {
            const double top = std::max(y - 0.5, 0.0) / map.height;
            const double bottom = std::min(y + 0.5, static_cast<double>(map.height)) / map.height;
            double corners = 0.0;
            for (const double u : {x - 0.5, x + 0.5})
                for (const double v : {y - 0.5, y + 0.5}) // clamped, texel centres both
                    corners += glm::dot(mapLookup(map, {u / map.width, v / map.height}), glm::dvec3(1.0));
            sum += distribution.scales[size_t{y} * map.width + x] * corners / 4.0 * 2.0 * pi / map.width *
                   (std::cos(pi * top) - std::cos(pi * bottom));
        }
    return sum;
}

TEST(EnvironmentDistribution, DensitiesIntegrateToOneForMapsOfAnySize) {
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(2, 1), glm::uvec2(1, 5), glm::uvec2(7, 3),
                                  glm::uvec2(64, 32), glm::uvec2(33, 65)}) {
        const Image map = randomMap(size.x, size.y, 2);
        const EnvironmentDistribution distribution = makeEnvironmentDistribution(map);
        ASSERT_EQ(distribution.scales.size(), size_t{map.width} * (map.height + 1));
        EXPECT_NEAR(totalProbability(map, distribution), 1.0, 1e-6) << size.x << " x " << size.y;
    }
}

TEST(EnvironmentDistribution, ConstantMapIsSampledUniformly) {
    const EnvironmentDistribution distribution =
        makeEnvironmentDistribution(constantMap(20, 10, glm::vec3(3.0f)));
    for (const float scale : distribution.scales)
        EXPECT_NEAR(scale * 9.0, 0.25 / pi, 1e-6);
    EXPECT_NEAR(distribution.meanRadiance.x, 3.0, 1e-9);
}

// Lookups in four cells see a texel, those around the seam too.
TEST(EnvironmentDistribution, CellsAroundALoneTexelAndNoOthersArePicked) {
    const Image map = sunMap(8, 8, {0, 4}, 1.0f, 0.0f);
    const EnvironmentDistribution distribution = makeEnvironmentDistribution(map);
    for (uint32_t y = 0; y <= 8; ++y)
        for (uint32_t x = 0; x < 8; ++x)
            EXPECT_EQ(distribution.scales[size_t{y} * 8 + x] > 0.0f, x <= 1 && (y == 4 || y == 5))
                << x << ", " << y;
}

// A sky 1e12 times as dark as the sun is beyond the resolution of the random numbers.
TEST(EnvironmentDistribution, TheFaintestSkyBesideASunKeepsADensity) {
    for (const float scale : makeEnvironmentDistribution(sunMap(256, 128, {3, 70}, 1e9f, 1e-3f)).scales)
        ASSERT_GT(scale, 0.0f);
}

TEST(EnvironmentDistribution, BlackMapHasNoDensityAndMakesNoLight) {
    for (const float scale : makeEnvironmentDistribution(constantMap(8, 4, glm::vec3(0.0f))).scales)
        EXPECT_EQ(scale, 0.0f);
    Scene scene;
    scene.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    scene.environmentMap = {"black", constantMap(8, 4, glm::vec3(0.0f))};
    const Lights lights = collectLights(scene, glm::vec3(1.0f), LightSelection::power);
    EXPECT_FALSE(lights.environment);
    EXPECT_EQ(lights.environmentRadiance, glm::vec3(0.0f)); // or camera rays would see the factor itself
}

TEST(EnvironmentDistribution, PowerOfAMapIsThatOfItsMeanTimesTheFactor) {
    Scene scene;
    scene.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    scene.environmentMap = {"grey", constantMap(8, 4, {1.0f, 2.0f, 3.0f})};
    const Lights lights = collectLights(scene, glm::vec3(0.5f), LightSelection::power);
    ASSERT_EQ(lights.powers.size(), 1u);
    EXPECT_NEAR(lights.powers[0] / environmentPower(glm::vec3(0.5f, 1.0f, 1.5f), scene.bounds), 1.0, 1e-6);
}

// A map beside a lamp of known power; the tree's column is the last.
TEST(EnvironmentDistribution, TheTreeSharesWithAMapByPowerBetweenAQuarterAndThreeQuarters) {
    Scene scene;
    scene.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    scene.environmentMap = {"grey", constantMap(8, 4, glm::vec3(1.0f))};
    scene.punctualLights.emplace_back();
    const double power = environmentPower(glm::vec3(1.0f), scene.bounds);
    for (const auto& [ratio, share] : {std::pair{1e-3, 0.25}, {1.0, 0.5}, {2.0, 2.0 / 3.0}, {1e3, 0.75}}) {
        scene.punctualLights[0].intensity = glm::vec3(power / (4.0 * pi * ratio));
        const Lights lights = collectLights(scene, glm::vec3(1.0f), LightSelection::tree);
        ASSERT_EQ(lights.table.size(), 2u);
        EXPECT_NEAR(lights.table[0].pmf, share, 1e-5) << ratio;
    }
}

} // namespace
} // namespace lavalight::test
