// Media along the whole path: what fills a solid attenuates every stretch of a path, whatever ends it, and
// shadow rays (KHR_materials_volume, "Attenuation").
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/media_scenes.h"

namespace lavalight::test {
namespace {

class Media : public MediaTest {};

// A segment ends on what stands in the absorber.
TEST_F(Media, AttenuateWhateverEndsTheSegment) {
    const Shape absorber = box({-2, -2, -1}, {2, 2, 1});
    const glm::vec3 color(0.9f, 0.8f, 0.7f);
    const auto seen = [&](const Material& inside, float height) {
        return SceneBuilder()
            .add(absorber, glassOf(1.0f, kMetreColor))
            .add(squareAt(0, 1), inside)
            .camera(down(height))
            .build();
    };
    const glm::dvec3 expected = glm::dvec3(color) * over(1.0);
    expectEverywhere(seen(unlit(color), 3.0f), expected);
    expectEverywhere(seen(light(color), 3.0f), expected);
    expectEverywhere(seen(unlit(color), 0.75f), glm::dvec3(color) * over(0.75)); // the camera is inside
    Material masked = unlit(color);
    masked.alphaMode = AlphaMode::mask;
    masked.alpha = 0.75f;
    expectEverywhere(seen(masked, 3.0f), expected);
    const Scene empty = SceneBuilder()
                            .add(absorber, glassOf(1.0f, kMetreColor))
                            .environment(color)
                            .camera(down(3.0f))
                            .build();
    expectEverywhere(empty, glm::dvec3(color) * over(2.0));
}

// Light, wall and camera are inside: 2 m and 3 m of medium.
TEST_F(Media, AttenuateShadowRays) {
    Scene scene = SceneBuilder()
                      .add(box({-9, -9, -9}, {9, 9, 9}), glassOf(1.0f, kMetreColor))
                      .add(squareAt(0, 5), lambert(glm::vec3(1.0f)))
                      .camera(down(3.0f))
                      .build();
    scene.punctualLights.emplace_back();
    scene.punctualLights.back().position = {0, 0, 2};
    scene.punctualLights.back().intensity =
        glm::vec3(4.0f * std::numbers::pi_v<float>); // radiance 1 right below
    scene.cameras.front().position = {0, 0, 3};
    scene.cameras.front().halfHeight = 0.001f;
    RenderSettings settings = imageSettings(4, 4, 4);
    settings.estimator.maxBounces = 1;
    const ImageMean mean = meanOf(renderScene(device(), scene, settings).rendering);
    const glm::dvec3 expected = over(5.0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean.mean[c] / expected[c], 1.0, 1e-4) << "channel " << c;
}

TEST_F(Media, OfNestedSolidsAreThoseOfTheInnermost) {
    const Scene scene =
        SceneBuilder()
            .add(box({-2, -2, -1.5f}, {2, 2, 1.5f}), glassOf(1.0f, glm::vec3(0.5f)))
            .add(box({-1.5f, -1.5f, -0.5f}, {1.5f, 1.5f, 0.5f}), glassOf(1.0f, {1.0f, 0.25f, 1.0f}))
            .environment(glm::vec3(1.0f))
            .camera(down(3.0f))
            .build();
    expectEverywhere(scene, {0.25, 0.0625, 0.25});
}

// The smaller body is the medium where two overlap, whichever was entered first.
TEST_F(Media, WhereSolidsOverlapAreThoseOfTheSmaller) {
    const glm::vec3 large(0.5f, 1.0f, 1.0f);
    const glm::vec3 small(1.0f, 0.5f, 1.0f);
    const glm::dvec3 expected = over(3.0, large) * over(2.0, small);
    for (const bool fromBelow : {false, true}) {
        Camera camera = down(fromBelow ? -5.0f : 5.0f);
        camera.forward = {0, 0, fromBelow ? 1 : -1};
        camera.right = {fromBelow ? -1 : 1, 0, 0};
        const Scene scene = SceneBuilder()
                                .add(box({-2, -2, -2}, {2, 2, 2}), glassOf(1.0f, large))
                                .add(box({-1, -1, 1}, {1, 1, 3}), glassOf(1.0f, small))
                                .environment(glm::vec3(1.0f))
                                .camera(camera)
                                .build();
        expectEverywhere(scene, expected);
    }
}

// Camera in the water, an object in a glass in the water. Radiance grows by the square of the index.
TEST_F(Media, LinkUpFromTheCameraToWhatItSees) {
    const glm::vec3 water(0.8f, 0.9f, 1.0f);
    const glm::vec3 tint(1.0f, 0.7f, 0.6f);
    const Scene scene = SceneBuilder()
                            .add(cube({0, 0, 0}, 9.0f), glassOf(1.33f, water))
                            .add(box({-3, -3, -1}, {3, 3, 1}), glassOf(1.5f, tint))
                            .add(squareAt(0.5f, 2.5f), unlit(glm::vec3(1.0f)))
                            .camera(down(4.0f))
                            .build();
    const double eta = 1.5 / 1.33;
    const glm::dvec3 expected = passing(1.33, 1.5) / (eta * eta) * over(3.0, water) * over(0.5, tint);
    expectMean(render(scene, 1024), expected, 0.002);
}

TEST_F(Media, OpenSurfacesKeepTheRuleOfBackFaces) {
    const Scene scene = SceneBuilder()
                            .add(squareAt(1), glassOf(1.0f, kMetreColor))
                            .add(squareAt(-1, 0.5f), unlit(glm::vec3(1.0f)))
                            .camera(down(3.0f))
                            .build();
    EXPECT_EQ(scene.openSolids, std::vector<std::string>{"mesh 0"});
    expectEverywhere(scene, glm::dvec3(1.0)); // nothing is lost behind its front
    Camera below = down(-3.0f);
    below.forward = {0, 0, 1};
    below.right = {-1, 0, 0};
    const Scene back = SceneBuilder()
                           .add(squareAt(-1), glassOf(1.0f, kMetreColor))
                           .environment(glm::vec3(1.0f))
                           .camera(below)
                           .build();
    expectEverywhere(back, over(2.0)); // between the camera and the back
}

TEST_F(Media, DiffuseSolidsAreBoundariesAndSeenFromInside) {
    Material wax = lambert(glm::vec3(0.0f)); // all that enters is spread inside, white
    wax.diffuseTransmission = 1.0f;
    wax.isSolid = true;
    wax.attenuationColor = kMetreColor;
    wax.attenuationDistance = 1.0f;
    const Scene inside = SceneBuilder()
                             .add(box({-9, -9, -1}, {9, 9, 1}), wax)
                             .environment(glm::vec3(1.0f))
                             .camera(down(0.0f))
                             .build();
    RenderSettings settings = imageSettings(16, 16, 4);
    settings.estimator.maxBounces = 1; // out through the lower face, whose back spreads the sky
    settings.estimator.roulette = Roulette::off;
    const RenderResult result = renderScene(device(), inside, settings);
    expectMean(result, over(1.0), 0.01);
}

// Light that a path finds beyond a boundary counts once, whether light samples are taken or not.
TEST_F(Media, HaveOneMeanWithAndWithoutLightSamples) {
    Material frosted = glassOf(1.5f, {0.7f, 0.9f, 0.8f});
    frosted.roughness = 0.4f;
    Material milk = lambert({0.2f, 0.2f, 0.3f});
    milk.diffuseTransmission = 0.6f;
    milk.isSolid = true;
    milk.attenuationColor = {0.8f, 0.6f, 0.4f};
    milk.attenuationDistance = 0.5f;
    const Scene scene = SceneBuilder()
                            .add(cube({0, 0, 0}, 1.0f), frosted)
                            .add(cube({0, 0.2f, 0}, 0.6f), glassOf(1.33f, {0.9f, 0.6f, 0.9f}))
                            .add(cube({0.3f, -0.7f, 0}, 0.5f), milk) // crosses the second
                            .add(rectangle({0, 0.4f, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}), light({5, 6, 7}))
                            .add(rectangle({0, 4, 0}, {1, 0, 0}, {0, 0, 1}), light({9, 8, 7}))
                            .add(rectangle({0, -1.2f, 0}, {0, 0, 4}, {4, 0, 0}), lambert(glm::vec3(0.6f)))
                            .environment(glm::vec3(0.2f))
                            .camera(lookAt({2, 1.5f, 4}, {0, 0, 0}, 0.6f))
                            .build();
    const auto with = [&](bool nee, Schedule schedule) {
        RenderSettings settings = imageSettings(16, 16, 1024);
        settings.estimator.maxBounces = 12;
        settings.estimator.nextEventEstimation = nee;
        settings.estimator.seed = nee ? 1 : 2;
        settings.work.schedule = schedule;
        return renderScene(device(), scene, settings);
    };
    const RenderResult direct = with(true, Schedule::fused);
    expectSameMean(direct.rendering, with(false, Schedule::fused).rendering, 4);
    EXPECT_EQ(direct.filmWords, with(true, Schedule::wavefront).filmWords);
}

} // namespace
} // namespace lavalight::test
