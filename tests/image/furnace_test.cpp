// Furnaces: scenes in which every direction has the same known radiance.
#include <cmath>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "compare/statistics.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr glm::vec3 kOrigin(0.0f);
const Camera kWholeBody = lookAt({1.5f, 2.0f, 3.0f}, kOrigin, 0.6f);
// Sees nothing but the inner part of a body of radius 1.
const Camera kInsideOutline = lookAtOrthographic({1.5f, 2.0f, 3.0f}, kOrigin, 0.5f);

// Three walls that meet in a corner: light bounces between them before it leaves.
Scene corner(const Material& material, const glm::vec3& environment) {
    const float s = 1.0f;
    return SceneBuilder()
        .add(rectangle({s, s, 0}, {s, 0, 0}, {0, s, 0}), material)
        .add(rectangle({0, s, s}, {0, s, 0}, {0, 0, s}), material)
        .add(rectangle({s, 0, s}, {0, 0, s}, {s, 0, 0}), material)
        .environment(environment)
        .camera(lookAtOrthographic({3, 3, 3}, {0.3f, 0.3f, 0.3f}, 0.4f))
        .build();
}

class Furnace : public DeviceTest {};

TEST_F(Furnace, WhiteBallInAWhiteFurnaceIsInvisible) {
    const Scene scene = SceneBuilder()
                            .add(ball(kOrigin, 1.0f), lambert(glm::vec3(1.0f)))
                            .environment(glm::vec3(1.0f))
                            .camera(kWholeBody)
                            .build();
    RenderSettings settings = imageSettings(48, 48, 16);
    settings.estimator.roulette = Roulette::off;
    expectEveryPixel(renderScene(device(), scene, settings), glm::dvec3(1.0));
}

TEST_F(Furnace, WhiteBodyWithHollowsIsInvisibleToo) {
    RenderSettings settings = imageSettings(32, 32, 16);
    settings.estimator.roulette = Roulette::off;
    settings.estimator.nextEventEstimation = false; // light samples meet the other walls, which is noise
    settings.estimator.maxBounces = 256;
    const RenderResult result =
        renderScene(device(), corner(lambert(glm::vec3(1.0f)), glm::vec3(1.0f)), settings);
    expectEveryPixel(result, glm::dvec3(1.0));
    EXPECT_EQ(result.tallies.cutPaths, 0u);
}

TEST_F(Furnace, RouletteKeepsTheMeanOfTheWhiteFurnace) {
    RenderSettings settings = imageSettings(32, 32, 64);
    settings.estimator.rouletteStart = 1;
    expectMean(renderScene(device(), corner(lambert(glm::vec3(1.0f)), glm::vec3(1.0f)), settings),
               glm::dvec3(1.0), 0.003);
}

TEST_F(Furnace, ConvexGreyBodyReflectsItsAlbedo) {
    const glm::vec3 albedo(0.5f, 0.25f, 0.9f);
    for (const Shape& shape : {ball(kOrigin, 1.0f), cube(kOrigin, 0.7f)}) {
        const Scene scene = SceneBuilder()
                                .add(shape, lambert(albedo))
                                .environment(glm::vec3(1.0f))
                                .camera(kInsideOutline)
                                .build();
        RenderSettings settings = imageSettings(32, 32, 16);
        settings.estimator.rouletteStart = 2;
        expectEveryPixel(renderScene(device(), scene, settings), albedo);
    }
}

TEST_F(Furnace, MirrorInAWhiteFurnaceIsInvisible) {
    Material mirror = lambert(glm::vec3(1.0f));
    mirror.metallic = 1.0f;
    mirror.roughness = 0.0f;
    const Scene scene = SceneBuilder()
                            .add(ball(kOrigin, 1.0f), mirror)
                            .environment(glm::vec3(1.0f))
                            .camera(kWholeBody)
                            .build();
    expectEveryPixel(renderScene(device(), scene, imageSettings(32, 32, 4)), glm::dvec3(1.0));
}

struct Gloss {
    const char* name;
    float metallic;
    float roughness;
    bool isSmooth;
};

std::ostream& operator<<(std::ostream& out, const Gloss& gloss) {
    return out << gloss.name;
}

class GlossyFurnace : public DeviceTest, public testing::WithParamInterface<Gloss> {};

// "Never above 1" holds tile by tile. The dielectric's base is white, so that it reflects all that the
// coating lets through and the whole is near 1; a metal loses what a single scattering cannot return.
TEST_P(GlossyFurnace, NeverReflectsMoreThanItReceives) {
    const Gloss& gloss = GetParam();
    Material material;
    material.metallic = gloss.metallic;
    material.roughness = gloss.roughness;
    SceneBuilder builder;
    gloss.isSmooth ? builder.addSmooth(ball(kOrigin, 1.0f), kOrigin, material)
                   : builder.add(ball(kOrigin, 1.0f), material);
    const Scene scene = builder.environment(glm::vec3(1.0f)).camera(kWholeBody).build();
    const Rendering rendering =
        downsample(renderScene(device(), scene, imageSettings(64, 64, 64)).rendering, 8);
    for (size_t i = 0; i < rendering.radiance().pixels.size(); ++i) {
        const double allowed = 1.0 + kRounding + kSigmas * std::sqrt(rendering.variance().pixels[i].g);
        EXPECT_LE(rendering.radiance().pixels[i].g, allowed) << "tile " << i;
    }
    EXPECT_GT(meanOf(rendering).mean.g, gloss.metallic > 0.0f || gloss.isSmooth ? 0.7 : 0.998);
}

INSTANTIATE_TEST_SUITE_P(
    Materials, GlossyFurnace,
    testing::Values(Gloss{"roughMetal", 1.0f, 1.0f, false}, Gloss{"satinMetal", 1.0f, 0.3f, false},
                    Gloss{"roughDielectric", 0.0f, 1.0f, false}, Gloss{"satinDielectric", 0.0f, 0.3f, false},
                    Gloss{"glossyDielectric", 0.0f, 0.1f, false},
                    Gloss{"mirrorDielectric", 0.0f, 0.0f, false}, Gloss{"blend", 0.5f, 0.4f, false},
                    Gloss{"smoothShadedDielectric", 0.0f, 0.3f, true}),
    [](const auto& strategy) { return std::string(strategy.param.name); });

struct Strategy {
    const char* name;
    bool nee;
    Mis mis;
    Roulette roulette;
};

std::ostream& operator<<(std::ostream& out, const Strategy& strategy) {
    return out << strategy.name;
}

// A closed body that glows with e and reflects the share a of what arrives holds e + a e + a^2 e + ...
// everywhere.
class ClosedFurnace : public DeviceTest, public testing::WithParamInterface<Strategy> {
  protected:
    static constexpr glm::dvec3 kAlbedo{0.5, 0.2, 0.7};
    static constexpr glm::dvec3 kEmission{0.25, 1.0, 0.3};

    [[nodiscard]] RenderResult renderInside(uint32_t maxBounces) {
        Material glowing = lambert(kAlbedo);
        glowing.emission = kEmission;
        const Scene scene = SceneBuilder()
                                .add(insideOut(ball(kOrigin, 1.0f)), glowing)
                                .camera(lookAt({0.1f, -0.2f, 0.05f}, {1.0f, 0.1f, 0.3f}, 1.2f))
                                .build();
        RenderSettings settings = imageSettings(32, 32, 32);
        settings.estimator.nextEventEstimation = GetParam().nee;
        settings.estimator.mis = GetParam().mis;
        settings.estimator.roulette = GetParam().roulette;
        settings.estimator.maxBounces = maxBounces;
        return renderScene(device(), scene, settings);
    }
};

TEST_P(ClosedFurnace, HoldsTheGeometricSeries) {
    const RenderResult result = renderInside(64);
    expectMean(result, kEmission / (1.0 - kAlbedo), 0.005);
}

TEST_P(ClosedFurnace, HoldsOneTermOfTheSeriesPerBounce) {
    glm::dvec3 expected(0.0);
    for (uint32_t bounces = 0; bounces < 4; ++bounces) {
        expected += kEmission * glm::pow(kAlbedo, glm::dvec3(bounces));
        SCOPED_TRACE(bounces);
        expectMean(renderInside(bounces), expected, 0.005);
    }
}

INSTANTIATE_TEST_SUITE_P(Strategies, ClosedFurnace,
                         testing::Values(Strategy{"powerAndRoulette", true, Mis::power, Roulette::throughput},
                                         Strategy{"powerWithoutRoulette", true, Mis::power, Roulette::off},
                                         Strategy{"balance", true, Mis::balance, Roulette::throughput},
                                         Strategy{"lightSamplesOnly", true, Mis::off, Roulette::throughput},
                                         Strategy{"bsdfSamplesOnly", false, Mis::power,
                                                  Roulette::throughput}),
                         [](const auto& strategy) { return std::string(strategy.param.name); });

} // namespace
} // namespace lavalight::test
