// What textures, vertex colours, normal maps and volumes make of surfaces, in scenes of known radiance.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/estimator_variants.h"
#include "support/mean_test.h"
#include "support/pictures.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

// A rectangle that fills the image, under a white sky.
Scene rectangleUnderTheSky(const Material& material) {
    return SceneBuilder()
        .add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), material)
        .environment(glm::vec3(1.0f))
        .camera(lookAtOrthographic({0, 0, 2}, {0, 0, 0}, 1.0f))
        .build();
}

double totalVariance(const Rendering& rendering) {
    double sum = 0.0;
    for (const glm::vec3& variance : rendering.variance().pixels)
        sum += variance.r + variance.g + variance.b;
    return sum;
}

class SurfaceDetail : public DeviceTest {};

TEST_F(SurfaceDetail, BaseColourIsFactorTimesTextureTimesVertexColour) {
    Scene scene = rectangleUnderTheSky(lambert({0.5f, 1.0f, 1.0f}));
    scene.pictures = {pictureOf(2, 1, {{255, 51, 0, 0}, {51, 255, 102, 0}})};
    putOnRectangle(scene, 0, TextureSlot::baseColor, textureOf(0));
    scene.meshes[0].colors.assign(4, glm::vec4(1.0f, 1.0f, 0.5f, 1.0f));
    const RenderResult result = renderScene(device(), scene, imageSettings(8, 8, 4));
    for (uint32_t x = 0; x < 8; ++x) {
        const glm::vec3 expected = x < 4 ? glm::vec3(0.5f, 0.2f, 0.0f) : glm::vec3(0.1f, 1.0f, 0.2f);
        EXPECT_LT(glm::length(result.rendering.radiance().pixels[x] - expected), 3e-5f)
            << x; // 16-bit colours
    }
}

// Where radiance is linear in the texture, one texel drawn by its share has the mean of all four.
TEST_F(SurfaceDetail, DrawnTexelsHaveTheMeanOfBilinearOnes) {
    Scene scene = rectangleUnderTheSky(lambert(glm::vec3(1.0f)));
    scene.pictures = {noisePicture(5, 3, false, 1)};
    Texture texture = textureOf(0);
    texture.isNearest = false;
    texture.isSrgb = true;
    putOnRectangle(scene, 0, TextureSlot::baseColor, texture);
    for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) {
        RenderSettings settings = imageSettings(16, 16, 4096);
        settings.estimator.sampler = sampler;
        const Rendering bilinear = renderScene(device(), scene, settings).rendering;
        settings.estimator.textureFilter = TextureFilter::stochastic;
        settings.estimator.seed = 1;
        const Rendering drawn = renderScene(device(), scene, settings).rendering;
        const MeanComparison comparison = compareMeans(drawn, bilinear);
        EXPECT_GT(comparison.share, 0.9) << comparison.text();
        EXPECT_LT(comparison.visibleBias, 0.003) << comparison.text();
        EXPECT_TRUE(comparison.same()) << comparison.text();
        EXPECT_GT(totalVariance(drawn), 2.0 * totalVariance(bilinear)); // or nothing was drawn
    }
}

TEST_F(SurfaceDetail, VertexColoursAreMixedByTheirDistance) {
    Scene scene = rectangleUnderTheSky(lambert(glm::vec3(1.0f)));
    scene.meshes[0].colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
    const RenderResult result = renderScene(device(), scene, imageSettings(8, 8, 256));
    for (uint32_t y = 0; y < 8; ++y)
        for (uint32_t x = 0; x < 8; ++x) {
            const glm::vec3& pixel = result.rendering.radiance().pixels[y * 8 + x];
            EXPECT_NEAR(pixel.r, (static_cast<float>(x) + 0.5f) / 8.0f, 0.02f);
            EXPECT_NEAR(pixel.g, (7.5f - static_cast<float>(y)) / 8.0f, 0.02f);
        }
}

TEST_F(SurfaceDetail, UnlitSurfacesShowTheirColourToAllRays) {
    Material unlit = lambert({0.25f, 0.5f, 3.0f});
    unlit.isUnlit = true;
    unlit.emission = glm::vec3(7.0f);
    expectEveryPixel(renderScene(device(), rectangleUnderTheSky(unlit), imageSettings(8, 8, 4)),
                     glm::dvec3(unlit.baseColor));
    // A grey body within an unlit room.
    Scene room = SceneBuilder()
                     .add(ball({0, 0, 0}, 1.0f), lambert(glm::vec3(0.5f)))
                     .add(insideOut(cube({0, 0, 0}, 5.0f)), unlit)
                     .camera(lookAtOrthographic({0, 1, 3}, {0, 0, 0}, 0.5f))
                     .build();
    expectEveryPixel(renderScene(device(), room, imageSettings(8, 8, 4)), 0.5 * glm::dvec3(unlit.baseColor));
}

// A mirror-like film of index 1 around a cube: nothing but attenuation.
TEST_F(SurfaceDetail, SolidsAttenuateExponentially) {
    Material body = lambert(glm::vec3(1.0f));
    body.transmission = 1.0f;
    body.roughness = 0.0f;
    body.ior = 1.0f;
    body.isSolid = true;
    body.attenuationColor = {0.5f, 0.25f, 1.0f};
    body.attenuationDistance = 0.7f;
    const Scene scene = SceneBuilder()
                            .add(cube({0, 0, 0}, 1.0f), body)
                            .environment(glm::vec3(1.0f))
                            .camera(lookAtOrthographic({0, 0, 3}, {0, 0, 0}, 0.9f))
                            .build();
    const glm::dvec3 expected = glm::pow(glm::dvec3(body.attenuationColor), glm::dvec3(2.0 / 0.7));
    RenderSettings settings = imageSettings(8, 8, 4);
    settings.estimator.roulette = Roulette::off;
    expectEveryPixel(renderScene(device(), scene, settings), expected);
}

// A normal map that leans by `lean` towards growing u, lit from the direction (sin a, 0, cos a).
double litByTheSun(gpu::Device& device, double angle, bool fromBehind, float bitangentSign,
                   glm::uvec2 texel) {
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), lambert(glm::vec3(1.0f)))
                      .camera(lookAtOrthographic({0, 0, fromBehind ? -2 : 2}, {0, 0, 0}, 0.9f))
                      .build();
    scene.materials[0].doubleSided = true;
    scene.pictures = {pictureOf(1, 1, {{texel.x, texel.y, 218, 255}})};
    putOnRectangle(scene, 0, TextureSlot::normal, textureOf(0));
    scene.meshes[0].normals.assign(4, {0, 0, 1});
    scene.meshes[0].tangents.assign(4, {1, 0, 0, bitangentSign});
    PunctualLight sun;
    sun.kind = PunctualKind::directional;
    sun.direction = -glm::vec3(std::sin(angle), 0.0, std::cos(angle));
    scene.punctualLights.push_back(sun);
    return meanOf(renderScene(device, scene, imageSettings(4, 4, 4)).rendering).mean.g * std::numbers::pi;
}

TEST_F(SurfaceDetail, NormalMapsTurnTheNormalTowardsTangentAndBitangent) {
    // 218 of 255 is 0.7098 to both sides of 127.5: 45 degrees.
    constexpr glm::uvec2 towardsU(218, 128);
    const double quarter = std::numbers::pi / 4.0;
    EXPECT_NEAR(litByTheSun(device(), quarter, false, 1.0f, towardsU), 1.0, 0.005);
    EXPECT_NEAR(litByTheSun(device(), -quarter, false, 1.0f, towardsU), 0.0, 0.01);
    EXPECT_NEAR(litByTheSun(device(), 0.0, false, -1.0f, towardsU), std::sqrt(0.5), 0.005);
    // From behind, the relief is that of the front, seen through: a dent towards u leans the other way.
    EXPECT_NEAR(litByTheSun(device(), std::numbers::pi + quarter, true, 1.0f, towardsU), 1.0, 0.005);
}

TEST_F(SurfaceDetail, TheSignOfTangentsMirrorsTheBitangent) {
    constexpr glm::uvec2 towardsV(128, 218);
    const auto leaning = [&](float sign, float y) {
        Scene scene = SceneBuilder()
                          .add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), lambert(glm::vec3(1.0f)))
                          .camera(lookAtOrthographic({0, 0, 2}, {0, 0, 0}, 0.9f))
                          .build();
        scene.pictures = {pictureOf(1, 1, {{towardsV.x, towardsV.y, 218, 255}})};
        putOnRectangle(scene, 0, TextureSlot::normal, textureOf(0));
        scene.meshes[0].tangents.assign(4, {1, 0, 0, sign});
        PunctualLight sun;
        sun.kind = PunctualKind::directional;
        sun.direction = glm::normalize(glm::vec3(0.0f, -y, -1.0f));
        scene.punctualLights.push_back(sun);
        return meanOf(renderScene(device(), scene, imageSettings(4, 4, 4)).rendering).mean.g *
               std::numbers::pi;
    };
    EXPECT_NEAR(leaning(1.0f, 1.0f), 1.0, 0.005);
    EXPECT_NEAR(leaning(1.0f, -1.0f), 0.0, 0.01);
    EXPECT_NEAR(leaning(-1.0f, -1.0f), 1.0, 0.005);
}

// A normal that looks away from the camera: what would be black.
TEST_F(SurfaceDetail, NormalsThatFaceAwayReflectStill) {
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), lambert(glm::vec3(1.0f)))
                      .environment(glm::vec3(1.0f))
                      .camera(lookAtOrthographic({-2, 0, 0.3f}, {0, 0, 0}, 0.05f))
                      .build();
    scene.pictures = {pictureOf(1, 1, {{250, 128, 150, 255}})};
    putOnRectangle(scene, 0, TextureSlot::normal, textureOf(0));
    scene.meshes[0].tangents.assign(4, {1, 0, 0, 1});
    EXPECT_GT(meanOf(renderScene(device(), scene, imageSettings(16, 16, 64)).rendering).mean.g, 0.4);
}

// Two lamps with pictures on them: one nearly black but for a corner, one with wraps and a transform, half of
// its texels transparent; a floor with a normal map and rough metal by texture.
Scene texturedLamps() {
    Material lamp = light({6, 5, 4});
    Material veil = light({2, 3, 4});
    veil.alphaMode = AlphaMode::blend;
    veil.doubleSided = true;
    Material floor = lambert({0.7f, 0.6f, 0.5f});
    floor.specular = 1.0f;
    floor.metallic = 1.0f;
    floor.roughness = 0.9f;
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0}), floor)
                      .add(ball({0, 0.8f, 0}, 0.6f), lambert({0.5f, 0.7f, 0.9f}))
                      .add(rectangle({0, 3, 0}, {1, 0, 0}, {0, 0, 1}), lamp)
                      .add(rectangle({1.2f, 1.2f, 0}, {0, 0, 0.8f}, {0, 0.8f, 0}), veil)
                      .camera(lookAt({2, 3, 5}, {0, 0.5f, 0}, 0.7f))
                      .build();
    scene.pictures = {pictureOf(2, 2, {{0, 0, 0, 255}, {255, 200, 100, 255}, {0, 0, 0, 255}, {0, 0, 0, 255}}),
                      noisePicture(3, 5, false, 1), noisePicture(4, 4, false, 2),
                      pictureOf(2, 1, {{118, 138, 230, 255}, {140, 120, 240, 255}})};
    Texture cornerOnly = textureOf(0);
    cornerOnly.isNearest = false;
    cornerOnly.isSrgb = true;
    cornerOnly.wrapU = cornerOnly.wrapV = Wrap::clamp;
    Texture noise = textureOf(1);
    noise.isNearest = false;
    noise.uRow = {2.0f, 0.5f, 0.3f};
    noise.wrapU = Wrap::mirror;
    putOnRectangle(scene, 0, TextureSlot::metallicRoughness, textureOf(2));
    putOnRectangle(scene, 0, TextureSlot::normal, textureOf(3));
    scene.meshes[0].tangents.assign(4, {0, 0, 1, 1});
    putOnRectangle(scene, 2, TextureSlot::emission, cornerOnly);
    putOnRectangle(scene, 3, TextureSlot::emission, noise);
    putOnRectangle(scene, 3, TextureSlot::baseColor, noise);
    return scene;
}

// The settings that weigh what is found by hitting a light against what is found by sampling it.
TEST_F(SurfaceDetail, LightsAreFoundAlikeBySamplingAndByHittingUnderTexturedLamps) {
    std::vector<Variant> variants = singleVariants();
    std::erase_if(variants, [](const Variant& v) {
        return v.settings.roulette != EstimatorSettings{}.roulette ||
               v.settings.hemisphere != Hemisphere::cosine;
    });
    expectOneMean(device(), texturedLamps(), variants, {512, 0.3});
}

} // namespace
} // namespace lavalight::test
