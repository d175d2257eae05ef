// Light from below a clear coat (KHR_materials_clearcoat, "Emission"): coated_emission = emission (1 -
// clearcoat F), F by Schlick with F0 = 0.04 around the coat's normal, at hits and in light samples alike.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gltf/import.h"
#include "support/estimator_variants.h"
#include "support/pictures.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

double transmittance(double coat, double cosine) {
    return 1.0 - coat * (0.04 + 0.96 * std::pow(1.0 - cosine, 5.0));
}

Material coated(const glm::vec3& radiance, float coat, float roughness) {
    Material material = light(radiance);
    material.clearcoat = coat;
    material.clearcoatRoughness = roughness;
    return material;
}

// A large quad that faces +z, seen by an orthographic camera `degrees` off its normal.
Scene quadSeenFrom(double degrees, const Material& material) {
    const double angle = degrees * M_PI / 180.0;
    return SceneBuilder()
        .add(rectangle({0, 0, 0}, {20, 0, 0}, {0, 20, 0}), material)
        .camera(lookAtOrthographic(5.0f * glm::vec3(std::sin(angle), 0.0, std::cos(angle)), {0, 0, 0}, 0.05f))
        .build();
}

class CoatedEmission : public DeviceTest {
  protected:
    [[nodiscard]] RenderResult seen(const Scene& scene) {
        return renderScene(device(), scene, imageSettings(4, 4, 4));
    }
};

TEST_F(CoatedEmission, IsDimmedAsTheExtensionSaysAtEveryAngleAndRoughness) {
    EXPECT_NEAR(transmittance(1.0, 1.0), 0.96, 1e-12);
    EXPECT_NEAR(transmittance(1.0, std::cos(80.0 * M_PI / 180.0)), 0.590, 1e-3);
    for (const float coat : {1.0f, 0.3f})
        for (const float roughness : {0.0f, 0.5f})
            for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0})
                expectEveryPixel(seen(quadSeenFrom(degrees, coated({1, 2, 3}, coat, roughness))),
                                 glm::dvec3(1, 2, 3) * transmittance(coat, std::cos(degrees * M_PI / 180.0)));
}

TEST_F(CoatedEmission, OfTheFieldIs059At80Degrees) {
    const Scene scene = importGltf(std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/coat80.glb");
    const double expected = transmittance(1.0, std::cos(80.0 * M_PI / 180.0));
    const RenderResult result = renderScene(device(), scene, imageSettings(16, 16, 4));
    const Image& image = result.rendering.radiance();
    for (uint32_t y = 0; y < 16; ++y) // rays of the right border start below the quad
        for (uint32_t x = 0; x < 12; ++x)
            EXPECT_NEAR(image.at(x, y).g, expected, 1e-4) << x;
}

TEST_F(CoatedEmission, BackOfADoubleSidedLightIsDimmedToo) {
    Material material = coated({1, 1, 1}, 1.0f, 0.0f);
    material.doubleSided = true;
    expectEveryPixel(seen(quadSeenFrom(120.0, material)), glm::dvec3(transmittance(1.0, 0.5)));
}

TEST_F(CoatedEmission, FollowsTheTexturesOfTheCoat) {
    Scene scene = quadSeenFrom(60.0, coated({1, 1, 1}, 0.5f, 0.0f));
    scene.pictures = {pictureOf(1, 1, {{102, 0, 0, 255}}), pictureOf(1, 1, {{218, 128, 218, 255}})};
    putOnRectangle(scene, 0, TextureSlot::clearcoat, textureOf(0)); // 0.4
    expectEveryPixel(seen(scene), glm::dvec3(transmittance(0.5 * 0.4, 0.5)));
    // A normal that leans by 45 degrees to +x, where the camera is.
    scene.materials[0].clearcoat = 1.0f;
    scene.materials[0].textures[static_cast<size_t>(TextureSlot::clearcoat)].reset();
    putOnRectangle(scene, 0, TextureSlot::clearcoatNormal, textureOf(1));
    scene.meshes[0].normals.assign(4, {0, 0, 1});
    scene.meshes[0].tangents.assign(4, {1, 0, 0, 1});
    const double seenBy = std::cos(15.0 * M_PI / 180.0);
    for (const glm::vec3& pixel : seen(scene).rendering.radiance().pixels)
        EXPECT_NEAR(pixel.g, transmittance(1.0, seenBy), 1e-4); // 128 of 255 is not quite the middle
}

// KHR_materials_sheen scales f_diffuse and f_specular below it, and says nothing of emission.
TEST_F(CoatedEmission, SheenLeavesEmissionAlone) {
    Material material = light({1, 1, 1});
    material.sheenColor = glm::vec3(1.0f);
    material.sheenRoughness = 0.5f;
    expectEveryPixel(seen(quadSeenFrom(60.0, material)), glm::dvec3(1.0));
}

// Below an endless ceiling, a white floor sends what the hemisphere does by the cosine: 1 - 0.04 - 0.96 / 21.
TEST_F(CoatedEmission, FloorBelowACoatedCeilingHasTheIntegralOverTheHemisphere) {
    const Scene scene =
        SceneBuilder()
            .add(rectangle({0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}), lambert(glm::vec3(1.0f)))
            .add(rectangle({0, 0, 1}, {0, 500, 0}, {500, 0, 0}), coated({1, 1, 1}, 1.0f, 0.0f))
            .camera(lookAtOrthographic({0, 0, 0.5f}, {0, 0, 0}, 0.05f))
            .build();
    for (const bool samplesLights : {true, false}) {
        RenderSettings settings = imageSettings(16, 16, samplesLights ? 1024 : 256);
        settings.estimator.nextEventEstimation = samplesLights;
        settings.estimator.sampler = Sampler::independent;
        settings.estimator.maxBounces = 1;
        expectMean(renderScene(device(), scene, settings), glm::dvec3(1.0 - 0.04 - 0.96 / 21.0), 0.003);
    }
}

// Lamps whose coat and emission have textures, one of them with bent normals; all that samples lights or hits
// them.
TEST_F(CoatedEmission, IsFoundAlikeBySamplingLightsAndByHittingThem) {
    Material lamp = coated({6, 5, 4}, 1.0f, 0.3f);
    Material veil = coated({2, 3, 4}, 0.8f, 0.0f);
    veil.doubleSided = true;
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0}), lambert({0.7f, 0.6f, 0.5f}))
                      .add(ball({0, 0.8f, 0}, 0.6f), lambert({0.5f, 0.7f, 0.9f}))
                      .add(rectangle({0, 3, 0}, {1, 0, 0}, {0, 0, 1}), lamp)
                      .add(rectangle({1.2f, 1.2f, 0}, {0, 0, 0.8f}, {0, 0.8f, 0}), veil)
                      .camera(lookAt({2, 3, 5}, {0, 0.5f, 0}, 0.7f))
                      .build();
    scene.pictures = {
        noisePicture(3, 5, false, 1), pictureOf(2, 1, {{40, 158, 200, 255}, {220, 120, 190, 255}}),
        pictureOf(2, 2, {{255, 0, 0, 255}, {0, 255, 0, 255}, {30, 0, 0, 255}, {255, 9, 9, 255}})};
    Texture noise = textureOf(0);
    noise.isNearest = false;
    putOnRectangle(scene, 2, TextureSlot::emission, noise);
    Texture coat = textureOf(2);
    coat.isNearest = false;
    putOnRectangle(scene, 2, TextureSlot::clearcoat, coat);
    putOnRectangle(scene, 3, TextureSlot::emission, coat);
    putOnRectangle(scene, 3, TextureSlot::clearcoat, coat);
    putOnRectangle(scene, 3, TextureSlot::clearcoatNormal, textureOf(1));
    scene.meshes[3].normals.assign(4, {1, 0, 0});
    scene.meshes[3].tangents.assign(4, {0, 0, 1, 1});
    std::vector<Variant> variants = singleVariants();
    std::erase_if(variants, [](const Variant& v) {
        return v.settings.roulette != EstimatorSettings{}.roulette ||
               v.settings.hemisphere != Hemisphere::cosine;
    });
    expectOneMean(device(), scene, variants, {512, 0.3});
}

} // namespace
} // namespace lavalight::test
