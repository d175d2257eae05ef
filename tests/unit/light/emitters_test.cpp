// Emissive triangles are found, numbered as the scene numbers them, and weighted by what they emit.
#include "light/emitters.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.h"

namespace lavalight::test {
namespace {

// A right-angled triangle of legs `side`.
Mesh corner(uint32_t material, float side) {
    return {"corner", material, {{0, 0, 0}, {side, 0, 0}, {0, side, 0}}, {}, {{0, 1, 2}}};
}

Material light(const glm::vec3& emission, bool doubleSided = false) {
    Material material;
    material.name = "light";
    material.emission = emission;
    material.doubleSided = doubleSided;
    return material;
}

Scene sceneOf(std::vector<Material> materials, std::vector<Mesh> meshes) {
    Scene scene;
    scene.materials = std::move(materials);
    scene.meshes = std::move(meshes);
    return scene;
}

TEST(Emitters, HavePowerAreaTimesPiTimesMeanRadiance) {
    const Emitters emitters = findEmitters(sceneOf({light({1.0f, 2.0f, 6.0f})}, {corner(0, 2.0f)}));
    ASSERT_EQ(emitters.list.size(), 1u);
    EXPECT_FLOAT_EQ(emitters.list[0].area, 2.0f);
    EXPECT_NEAR(emitters.list[0].power, 2.0 * std::numbers::pi * 3.0, 1e-6);
}

// KHR_materials_clearcoat, "Emission": Schlick's 0.04 + 0.96 (1 - x)^5, averaged over the hemisphere, is 0.04
// + 0.96 / 21.
TEST(Emitters, BelowACoatHaveThePowerThatItLetsThrough) {
    Material coated = light(glm::vec3(1.0f));
    coated.clearcoat = 0.5f;
    const double through = 1.0 - 0.5 * (0.04 + 0.96 / 21.0);
    EXPECT_NEAR(findEmitters(sceneOf({coated}, {corner(0, 1)})).list.at(0).power,
                through * 0.5 * std::numbers::pi, 1e-7);
    Scene textured = sceneOf({coated}, {corner(0, 1)});
    textured.pictures = {Picture{"half", 1, 1, false, {51, 0, 0, 255}}};
    textured.materials[0].textures[static_cast<size_t>(TextureSlot::clearcoat)] = Texture{};
    EXPECT_NEAR(findEmitters(textured).list.at(0).power,
                (1.0 - 0.2 * (1.0 - through)) * 0.5 * std::numbers::pi, 1e-7);
}

TEST(Emitters, EmitTwiceWhenDoubleSided) {
    const Emitters emitters = findEmitters(
        sceneOf({light(glm::vec3(1.0f)), light(glm::vec3(1.0f), true)}, {corner(0, 1), corner(1, 1)}));
    ASSERT_EQ(emitters.list.size(), 2u);
    EXPECT_NEAR(emitters.list[1].power, 2.0 * emitters.list[0].power, 1e-9);
}

TEST(Emitters, AreNumberedAcrossMeshes) {
    Mesh two = corner(0, 1.0f);
    two.triangles.push_back({0, 1, 2});
    const Emitters emitters = findEmitters(
        sceneOf({Material{}, light(glm::vec3(1.0f))}, {two, corner(1, 1.0f), two, corner(1, 2.0f)}));
    ASSERT_EQ(emitters.list.size(), 2u);
    EXPECT_EQ(emitters.list[0].triangle, 2u);
    EXPECT_EQ(emitters.list[1].triangle, 5u);
    EXPECT_EQ(emitters.emitterOfTriangle,
              (std::vector<uint32_t>{kNoEmitter, kNoEmitter, 0, kNoEmitter, kNoEmitter, 1}));
    EXPECT_NEAR(emitters.list[1].power, 4.0 * emitters.list[0].power, 1e-9);
}

TEST(Emitters, LeaveOutTrianglesWithoutAreaOrEmission) {
    const Emitters emitters =
        findEmitters(sceneOf({Material{}, light(glm::vec3(1.0f))}, {corner(1, 0.0f), corner(0, 1.0f)}));
    EXPECT_TRUE(emitters.list.empty());
    EXPECT_EQ(emitters.emitterOfTriangle, (std::vector<uint32_t>{kNoEmitter, kNoEmitter}));
}

TEST(Emitters, RefuseInfinitePowerAndNameTheMaterial) {
    const Scene scene =
        sceneOf({light(glm::vec3(std::numeric_limits<float>::infinity()))}, {corner(0, 1.0f)});
    try {
        (void)findEmitters(scene);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'light'"), std::string::npos);
    }
}

} // namespace
} // namespace lavalight::test
