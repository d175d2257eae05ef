// Glass whose index is that of what surrounds it cannot be seen (Snell, Fresnel: KHR_materials_ior,
// KHR_materials_transmission).
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "gltf/import.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

Material glass(float ior, float roughness, bool isSolid) {
    Material glass = lambert(glm::vec3(1.0f));
    glass.transmission = 1.0f;
    glass.ior = ior;
    glass.roughness = roughness;
    glass.isSolid = isSolid;
    return glass;
}

// A ball around the origin that fills the image, in a white furnace.
Scene inTheFurnace(const Material& material) {
    return SceneBuilder()
        .add(ball(glm::vec3(0.0f), 1.0f), material)
        .environment(glm::vec3(1.0f))
        .camera(lookAtOrthographic({1.5f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.7f))
        .build();
}

class MatchedIndex : public DeviceTest {};

TEST_F(MatchedIndex, SlabOfTheFieldIsInvisible) {
    const std::filesystem::path source(LAVALIGHT_SOURCE_DIR);
    Scene scene = importGltf(source / "tests/field/slab_r0.5.glb");
    scene.environment = glm::vec3(1.0f);
    expectEveryPixel(renderScene(device(), scene, imageSettings(16, 16, 16)), glm::dvec3(1.0));
}

TEST_F(MatchedIndex, BallsAndShellsOfEveryRoughnessAreInvisibleWithBothFresnels) {
    for (const float roughness : {0.0f, 0.05f, 0.3f, 0.5f, 1.0f})
        for (const bool isSolid : {false, true})
            for (const Fresnel fresnel : {Fresnel::exact, Fresnel::schlick}) {
                SCOPED_TRACE(std::to_string(roughness) + (isSolid ? ", solid" : ", thin"));
                RenderSettings settings = imageSettings(16, 16, 8);
                settings.estimator.fresnel = fresnel;
                expectEveryPixel(
                    renderScene(device(), inTheFurnace(glass(1.0f, roughness, isSolid)), settings),
                    glm::dvec3(1.0));
            }
}

// Red gets index 1.02 - 0.02 * 0.025 * 40 = 1; the other channels lose what facets mask.
TEST_F(MatchedIndex, ChannelThatDispersionBringsToIndexOnePassesWhole) {
    Material body = glass(1.02f, 0.7f, true);
    body.dispersion = 40.0f;
    const RenderResult result = renderScene(device(), inTheFurnace(body), imageSettings(32, 32, 256));
    const ImageMean mean = meanOf(result.rendering);
    EXPECT_NEAR(mean.mean.r, 1.0, 4.5 * mean.standardError.r);
    EXPECT_LT(mean.standardError.r, 0.01);
    EXPECT_LT(mean.mean.b, 0.9);
    EXPECT_GT(mean.mean.b, 0.4);
}

// Index 0 stands for an infinite one: all is reflected, and nothing enters that a black base colour, or what
// fills a body, would swallow.
TEST_F(MatchedIndex, IndexZeroIsAMirrorWithOrWithoutDispersion) {
    for (const float dispersion : {0.0f, 1.0f})
        for (const bool isSolid : {false, true})
            for (const bool attenuates : {false, true}) {
                Material mirror = glass(0.0f, 0.0f, isSolid);
                mirror.baseColor = glm::vec3(0.0f);
                mirror.dispersion = dispersion;
                mirror.attenuationColor = glm::vec3(attenuates ? 0.5f : 1.0f);
                mirror.attenuationDistance = 1.0f;
                SCOPED_TRACE(testing::Message() << dispersion << (isSolid ? ", solid" : ", thin"));
                expectEveryPixel(renderScene(device(), inTheFurnace(mirror), imageSettings(16, 16, 8)),
                                 glm::dvec3(1.0));
            }
}

TEST_F(MatchedIndex, IndexZeroIsAMirrorFromBehindAsWell) {
    for (const bool isSolid : {false, true}) {
        Material mirror = glass(0.0f, 0.0f, isSolid);
        mirror.doubleSided = true;
        const Scene scene = SceneBuilder()
                                .add(rectangle({0, 0, 0}, {0, 0, 9}, {9, 0, 0}), mirror)
                                .add(rectangle({0, 5, 0}, {99, 0, 0}, {0, 0, 99}), light(glm::vec3(3.0f)))
                                .add(rectangle({0, -5, 0}, {0, 0, 99}, {99, 0, 0}), light(glm::vec3(1.0f)))
                                .camera(lookAtOrthographic({1.0f, -2.0f, 1.5f}, glm::vec3(0.0f), 0.7f))
                                .build();
        SCOPED_TRACE(isSolid ? "solid" : "thin");
        expectEveryPixel(renderScene(device(), scene, imageSettings(16, 16, 8)), glm::dvec3(1.0));
    }
}

} // namespace
} // namespace lavalight::test
