// Tests of materials, of the extensions and of what stands in for missing light.
#include <cmath>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// A triangle with `material`.
GltfBuilder triangleOf(Json material) {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.json["materials"] = Json::array({std::move(material)});
    builder.addNode({{"mesh", mesh}});
    return builder;
}

Material importMaterial(Json material) {
    return triangleOf(std::move(material)).import().materials.at(0);
}

TEST(GltfMaterial, FactorsAreRead) {
    const Material material = importMaterial(
        {{"name", "paint"},
         {"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}, {"metallicFactor", 0.4}, {"roughnessFactor", 0.5}}}});
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_FLOAT_EQ(material.metallic, 0.4f);
    EXPECT_FLOAT_EQ(material.roughness, 0.5f);
    EXPECT_TRUE(material.doubleSided);
}

TEST(GltfMaterial, DefaultsAreThoseOfGltf) {
    const Material material = importMaterial(Json::object());
    EXPECT_EQ(material.baseColor, glm::vec3(1.0f));
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.emission, glm::vec3(0.0f));
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_EQ(material.specular, 1.0f);
    EXPECT_FALSE(material.doubleSided);
}

TEST(GltfMaterial, PrimitiveWithoutMaterialGetsTheDefaultOne) {
    GltfBuilder builder = triangleOf({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    builder.json["meshes"][0]["primitives"][0].erase("material");
    const Scene scene = builder.import();
    EXPECT_EQ(scene.meshes.at(0).material, 1u);
    EXPECT_EQ(scene.materials.at(1).metallic, 1.0f);
}

TEST(GltfMaterial, EmissiveStrengthMultipliesEvenWhereItIsAnInteger) {
    const Material material = importMaterial(
        {{"emissiveFactor", {1, 0.5, 0.25}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10'000'000'000}}}}}});
    EXPECT_EQ(material.emission, glm::vec3(1e10f, 0.5e10f, 0.25e10f));
}

TEST(GltfMaterial, SpecularAndIorAreRead) {
    const Material material = importMaterial(
        {{"extensions",
          {{"KHR_materials_specular", {{"specularFactor", 0}, {"specularColorFactor", {0.5, 1, 2}}}},
           {"KHR_materials_ior", {{"ior", 1.33}}}}}});
    EXPECT_EQ(material.specular, 0.0f);
    EXPECT_EQ(material.specularColor, glm::vec3(0.5f, 1.0f, 2.0f));
    EXPECT_FLOAT_EQ(material.ior, 1.33f);
}

TEST(GltfMaterial, IorOfZeroIsKeptAsTheSpecialValueItIs) {
    const GltfBuilder builder = triangleOf({{"extensions", {{"KHR_materials_ior", {{"ior", 0}}}}}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.materials.at(0).ior, 0.0f);
    EXPECT_EQ(warningsWith(scene, "ior"), 0);
}

TEST(GltfMaterial, FactorsOutOfRangeAreClampedWithAWarningThatNamesTheMaterial) {
    const Scene scene =
        triangleOf(
            {{"name", "odd"},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", {2, -1, 0.5, 1}}, {"metallicFactor", 3}, {"roughnessFactor", -1}}},
             {"extensions",
              {{"KHR_materials_ior", {{"ior", 0.5}}}, {"KHR_materials_specular", {{"specularFactor", 7}}}}}})
            .import();
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.baseColor, glm::vec3(1.0f, 0.0f, 0.5f));
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 0.0f);
    EXPECT_EQ(material.ior, 1.0f);
    EXPECT_EQ(material.specular, 1.0f);
    for (const char* factor :
         {"baseColorFactor", "metallicFactor", "roughnessFactor", "ior", "specularFactor"}) {
        EXPECT_EQ(warningsWith(scene, std::string(factor) + " was clamped"), 1) << factor;
    }
    EXPECT_EQ(warningsWith(scene, "material 0 \"odd\""), 5);
}

Json glass(Json transmission, Json volume) {
    return {{"name", "pane"},
            {"extensions",
             {{"KHR_materials_transmission", std::move(transmission)},
              {"KHR_materials_volume", std::move(volume)}}}};
}

TEST(GltfMaterial, TransmissionIsOfAThinWallUnlessItHasThickness) {
    const Material thin =
        importMaterial({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}}}});
    EXPECT_FLOAT_EQ(thin.transmission, 0.75f);
    EXPECT_FALSE(thin.isSolid);
    const Json factor = {{"transmissionFactor", 1}};
    EXPECT_FALSE(importMaterial(glass(factor, {{"thicknessFactor", 0}})).isSolid);
    EXPECT_TRUE(importMaterial(glass(factor, {{"thicknessFactor", 0.01}})).isSolid);
    const Material plain = importMaterial(glass(Json::object(), Json::object()));
    EXPECT_EQ(plain.transmission, 0.0f);
    EXPECT_FALSE(plain.isSolid);
}

TEST(GltfMaterial, TransmissionAndThicknessOutOfRangeAreClampedWithAWarning) {
    const Scene scene = triangleOf(glass({{"transmissionFactor", 2}}, {{"thicknessFactor", -1}})).import();
    EXPECT_EQ(scene.materials.at(0).transmission, 1.0f);
    EXPECT_FALSE(scene.materials.at(0).isSolid);
    EXPECT_EQ(warningsWith(scene, "transmissionFactor was clamped to 0 .. 1: material 0 \"pane\""), 1);
    EXPECT_EQ(warningsWith(scene, "thicknessFactor was clamped"), 1);
}

TEST(GltfMaterial, AttenuationIsRead) {
    const Json green = {0.1, 0.9, 0.1};
    const Material material = importMaterial(
        glass({{"transmissionFactor", 1}},
              {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", green}}));
    EXPECT_EQ(material.attenuationColor, glm::vec3(0.1f, 0.9f, 0.1f));
    EXPECT_FLOAT_EQ(material.attenuationDistance, 2.0f);
    EXPECT_EQ(importMaterial(glass(Json::object(), {{"thicknessFactor", 1}})).attenuationDistance,
              kNoAttenuation);
}

TEST(GltfMaterial, LayersAreRead) {
    const Material m = importMaterial(
        {{"extensions",
          {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.25}, {"clearcoatRoughnessFactor", 0.125}}},
           {"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 1}}, {"sheenRoughnessFactor", 0.75}}},
           {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.5}}},
           {"KHR_materials_iridescence",
            {{"iridescenceFactor", 1}, {"iridescenceIor", 1.75}, {"iridescenceThicknessMaximum", 500}}},
           {"KHR_materials_dispersion", {{"dispersion", 2}}},
           {"KHR_materials_diffuse_transmission",
            {{"diffuseTransmissionFactor", 0.5}, {"diffuseTransmissionColorFactor", {1, 0.5, 0}}}}}}});
    EXPECT_EQ(m.clearcoat, 0.25f);
    EXPECT_EQ(m.clearcoatRoughness, 0.125f);
    EXPECT_EQ(m.sheenColor, glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_EQ(m.sheenRoughness, 0.75f);
    EXPECT_EQ(m.anisotropy, 0.5f);
    EXPECT_EQ(m.anisotropyRotation, 1.5f);
    EXPECT_EQ(m.iridescence, 1.0f);
    EXPECT_EQ(m.iridescenceIor, 1.75f);
    EXPECT_EQ(m.iridescenceThicknessMinimum, 100.0f);
    EXPECT_EQ(m.iridescenceThicknessMaximum, 500.0f);
    EXPECT_EQ(m.dispersion, 2.0f);
    EXPECT_EQ(m.diffuseTransmission, 0.5f);
    EXPECT_EQ(m.diffuseTransmissionColor, glm::vec3(1.0f, 0.5f, 0.0f));
}

TEST(GltfMaterial, SpecularGlossinessIsADielectricWhoseF0IsItsColour) {
    const Material m = importMaterial({{"extensions",
                                        {{"KHR_materials_pbrSpecularGlossiness",
                                          {{"diffuseFactor", {0.5, 0.25, 0.125, 0.75}},
                                           {"specularFactor", {0.1, 0.2, 0.3}},
                                           {"glossinessFactor", 0.75}}}}}});
    EXPECT_EQ(m.baseColor, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(m.alpha, 0.75f);
    EXPECT_EQ(m.metallic, 0.0f);
    EXPECT_EQ(m.ior, 0.0f); // F0 = specularColor
    EXPECT_EQ(m.specularColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_FLOAT_EQ(m.roughness, 0.25f);
    EXPECT_TRUE(m.isGlossiness);
}

TEST(GltfMaterial, AlphaModesAreRead) {
    const Json color = {{"baseColorFactor", {1, 1, 1, 0.25}}};
    const Material mask =
        importMaterial({{"alphaMode", "MASK"}, {"alphaCutoff", 0.75}, {"pbrMetallicRoughness", color}});
    EXPECT_EQ(mask.alphaMode, AlphaMode::mask);
    EXPECT_EQ(mask.alphaCutoff, 0.75f);
    EXPECT_EQ(mask.alpha, 0.25f);
    EXPECT_EQ(importMaterial({{"alphaMode", "BLEND"}}).alphaMode, AlphaMode::blend);
    EXPECT_EQ(importMaterial({{"alphaMode", "MASK"}}).alphaCutoff, 0.5f);
    EXPECT_EQ(importMaterial(Json::object()).alphaMode, AlphaMode::opaque);
}

TEST(GltfMaterial, UnlitSurfaceIsNoLightWhateverItsEmission) {
    const Scene scene =
        triangleOf({{"emissiveFactor", {1, 1, 1}}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}})
            .import();
    EXPECT_TRUE(scene.materials.at(0).isUnlit);
    EXPECT_EQ(scene.materials.at(0).emission, glm::vec3(0.0f));
    EXPECT_EQ(warningsWith(scene, "KHR_materials_unlit"), 0);
}

TEST(GltfMaterial, GlassExtensionsAreCheckedLikeTheRest) {
    const auto error = [](const Json& transmission, const Json& volume) {
        return importError(triangleOf(glass(transmission, volume)));
    };
    const Json none = Json::object();
    EXPECT_NE(error({{"transmissionFactor", "1"}}, none).find("transmissionFactor is not a number"),
              std::string::npos);
    EXPECT_NE(error(none, {{"thicknessFactor", true}}).find("thicknessFactor is not a number"),
              std::string::npos);
    EXPECT_NE(error(none, {{"attenuationDistance", {1}}}).find("attenuationDistance is not a number"),
              std::string::npos);
    EXPECT_NE(error(none, {{"attenuationColor", {1}}}).find("has 1 elements instead of 3"),
              std::string::npos);
    EXPECT_NE(error({{"transmissionTexture", {{"index", 4}}}}, none)
                  .find("transmissionTexture.index is 4, but the file has 0 textures"),
              std::string::npos);
    EXPECT_NE(error(none, {{"thicknessTexture", {{"index", 4}}}}).find("thicknessTexture.index is 4"),
              std::string::npos);
}

TEST(GltfMaterial, EmissiveFactorAboveOneIsTakenAsItIsWithAWarning) {
    const Scene scene = triangleOf({{"emissiveFactor", {17, 12, 4}}}).import();
    EXPECT_EQ(scene.materials.at(0).emission, glm::vec3(17, 12, 4));
    EXPECT_EQ(warningsWith(scene, "emissiveFactor above 1"), 1);
}

TEST(GltfMaterial, HugeEmissionStaysFinite) {
    const Material material = importMaterial(
        {{"emissiveFactor", {1, 1, 1}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e300}}}}}});
    EXPECT_TRUE(std::isfinite(material.emission.x));
    EXPECT_GT(material.emission.x, 1e9f);
}

TEST(GltfMaterial, SceneWithoutLightIsMarkedAndWhiteAround) {
    const Scene dark = triangleOf(Json::object()).import();
    EXPECT_FALSE(dark.hasOwnLight);
    EXPECT_EQ(dark.environment, glm::vec3(1.0f));
    const Scene lit = triangleOf({{"emissiveFactor", {0, 1, 0}}}).import();
    EXPECT_TRUE(lit.hasOwnLight);
    EXPECT_EQ(lit.environment, glm::vec3(0.0f));
}

TEST(GltfMaterial, LightOfAMaterialThatNothingWearsIsNoLight) {
    GltfBuilder builder = triangleOf({{"emissiveFactor", {1, 1, 1}}});
    builder.json["materials"].push_back(Json::object());
    builder.json["meshes"][0]["primitives"][0]["material"] = 1;
    EXPECT_EQ(builder.import().environment, glm::vec3(1.0f));
}

TEST(GltfExtensions, UnsupportedOnesWarnOnceEachByTheirExactName) {
    GltfBuilder builder = triangleOf(
        {{"extensions", {{"VENDOR_materials_fur", Json::object()}, {"KHR_materials_ior", Json::object()}}}});
    builder.json["extensionsUsed"] = {"ADOBE_materials_paint", "KHR_materials_ior"};
    builder.json["nodes"][0]["extensions"] = {{"ADOBE_materials_paint", Json::object()}};
    const Scene scene = builder.import();
    EXPECT_EQ(warningsWith(scene, "ADOBE_materials_paint"), 1);
    EXPECT_EQ(warningsWith(scene, "VENDOR_materials_fur"), 1); // in use, though not listed
    EXPECT_EQ(warningsWith(scene, "KHR_materials_ior"), 0);
    EXPECT_EQ(scene.ignoredExtensions,
              (std::vector<std::string>{"ADOBE_materials_paint", "VENDOR_materials_fur"}));
    EXPECT_EQ(scene.extensionsUsed, (std::vector<std::string>{"ADOBE_materials_paint", "KHR_materials_ior"}));
}

TEST(GltfExtensions, RequiredAndUnsupportedIsAnErrorWithTheExactName) {
    GltfBuilder builder = triangleOf(Json::object());
    builder.json["extensionsRequired"] = {"KHR_materials_ior"};
    EXPECT_EQ(importError(builder), "");
    builder.json["extensionsRequired"].push_back("EXT_nobody_knows");
    EXPECT_NE(importError(builder).find("EXT_nobody_knows"), std::string::npos);
}

} // namespace
} // namespace lavalight::test
