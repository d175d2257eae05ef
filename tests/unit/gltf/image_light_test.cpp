// Tests of EXT_lights_image_based: which face is where, what its texels mean, and what stands in for bad
// ones.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/base64.h"
#include "image/cube_map.h"
#include "image/png.h"
#include "image/srgb.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

constexpr const char* kExtension = "EXT_lights_image_based";

std::string pngUri(uint32_t pixel, uint32_t size = 4) {
    const std::vector<uint32_t> pixels(size_t{size} * size, pixel);
    return "data:image/png;base64," + encodeBase64(encodePng(size, size, pixels));
}

// A scene lit by six faces of one colour each.
GltfBuilder lit(const std::vector<uint32_t>& faces) {
    GltfBuilder builder;
    const int node = builder.addNode({{"mesh", builder.addTriangle()}});
    Json numbers = Json::array();
    for (size_t i = 0; i < faces.size(); ++i) {
        builder.json["images"].push_back({{"uri", pngUri(faces[i])}});
        numbers.push_back(i);
    }
    builder.json["extensions"][kExtension]["lights"] = {{{"specularImages", Json::array({numbers})},
                                                         {"specularImageSize", 4},
                                                         {"irradianceCoefficients", Json::array()}}};
    builder.json["scenes"] = {{{"nodes", {node}}, {"extensions", {{kExtension, {{"light", 0}}}}}}};
    return builder;
}

Json& lightOf(GltfBuilder& builder) {
    return builder.json["extensions"][kExtension]["lights"][0];
}

// The radiance of a direction, by the convention of environment maps.
glm::vec3 radianceTowards(const Scene& scene, const glm::dvec3& d) {
    const Image& image = scene.environmentMap.value().image;
    const double u = std::atan2(d.z, d.x) / (2.0 * std::numbers::pi) + 0.5;
    const double v = std::acos(d.y / glm::length(d)) / std::numbers::pi;
    const auto x = std::min(static_cast<uint32_t>(u * image.width), image.width - 1);
    const auto y = std::min(static_cast<uint32_t>(v * image.height), image.height - 1);
    return image.at(x, y);
}

const std::vector<uint32_t> kSixFaces = {0xFF000010, 0xFF000020, 0xFF000030,
                                         0xFF000040, 0xFF000050, 0xFF000060};
const std::vector<glm::dvec3> kSixDirections = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                                {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};

void expectFace(const Scene& scene, const glm::dvec3& direction, size_t face) {
    const auto red = static_cast<float>(decodeSrgb((kSixFaces[face] & 0xFFu) / 255.0));
    EXPECT_NEAR(radianceTowards(scene, direction).x, red, 1e-5f) << face;
}

TEST(GltfImageLight, FacesAreWhereTheirAxesPoint) {
    const Scene scene = lit(kSixFaces).import();
    ASSERT_TRUE(scene.environmentMap.has_value());
    EXPECT_TRUE(scene.hasOwnLight);
    EXPECT_TRUE(scene.ignoredExtensions.empty());
    for (size_t face = 0; face < 6; ++face)
        expectFace(scene, kSixDirections[face], face);
}

TEST(GltfImageLight, ARotationTurnsTheLight) {
    GltfBuilder builder = lit(kSixFaces);
    const double half = std::sqrt(0.5); // a quarter turn about y takes +x to -z
    lightOf(builder)["rotation"] = {0, half, 0, half};
    const Scene scene = builder.import();
    expectFace(scene, {0, 0, -1}, 0);
    expectFace(scene, {1, 0, 0}, 4);
    expectFace(scene, {0, 1, 0}, 2);
}

TEST(GltfImageLight, AlphaDividesAndIntensityMultiplies) {
    GltfBuilder builder = lit(std::vector<uint32_t>(6, 0x33FF8000));
    lightOf(builder)["intensity"] = 3.0;
    const glm::vec3 radiance = radianceTowards(builder.import(), {0.3, 0.2, -0.9});
    EXPECT_NEAR(radiance.x, 0.0f, 1e-6f);
    EXPECT_NEAR(radiance.y, 15.0f * static_cast<float>(decodeSrgb(128.0 / 255.0)), 1e-4f);
    EXPECT_NEAR(radiance.z, 15.0f, 1e-4f);
}

TEST(GltfImageLight, RowsOfSideFacesRunDownwardsAndColumnsMirrored) {
    CubeMap cube;
    for (Image& face : cube)
        face = Image(2, 2);
    cube[0].pixels = {glm::vec3(1), glm::vec3(2), glm::vec3(3), glm::vec3(4)};
    EXPECT_EQ(lookUp(cube, {1.0, 0.5, 0.5}).x, 1.0f); // upper row, s from +z
    EXPECT_EQ(lookUp(cube, {1.0, 0.5, -0.5}).x, 2.0f);
    EXPECT_EQ(lookUp(cube, {1.0, -0.5, 0.5}).x, 3.0f);
    EXPECT_EQ(lookUp(cube, {1.0, -0.5, -0.5}).x, 4.0f);
}

TEST(GltfImageLight, WithoutFacesTheCoefficientsLight) {
    GltfBuilder builder = lit({0xFF000010});
    Json coefficients = Json::array();
    for (size_t i = 0; i < 9; ++i)
        coefficients.push_back({0.0, 0.0, 0.0});
    const double pi = std::numbers::pi;
    coefficients[0] = {pi * 2 / 0.282095, 0.0, 0.0};     // radiance 2 from everywhere, in red
    coefficients[1] = {0.0, 2 * pi / 3 / 0.488603, 0.0}; // and y in green, where that is not negative
    lightOf(builder)["irradianceCoefficients"] = coefficients;
    const Scene scene = builder.import();
    EXPECT_EQ(
        warningsWith(scene, "is lit by its irradiance coefficients alone: a cube map has six faces, not 1"),
        1);
    EXPECT_NEAR(radianceTowards(scene, {1, 0, 0}).x, 2.0f, 1e-3f);
    EXPECT_NEAR(radianceTowards(scene, {0, 1, 0}).y, 1.0f, 1e-2f);
    EXPECT_NEAR(radianceTowards(scene, {0, -1, 0}).y, 0.0f, 1e-6f);
}

TEST(GltfImageLight, FacesThatAreNotThereAreNoted) {
    GltfBuilder builder = lit(kSixFaces);
    lightOf(builder)["specularImages"][0][3] = 99;
    EXPECT_EQ(warningsWith(builder.import(), "the file has 6 images, and a face is another one"), 1);
    lightOf(builder)["specularImages"] = "none";
    EXPECT_EQ(warningsWith(builder.import(), "six faces, not 0"), 1);
    builder.json["scenes"][0]["extensions"][kExtension]["light"] = 5;
    EXPECT_NE(importError(builder).find("light"), std::string::npos);
}

TEST(GltfImageLight, AScenesLightIsThatOfTheChosenScene) {
    GltfBuilder builder = lit(kSixFaces);
    builder.json["scenes"].push_back({{"nodes", {0}}});
    EXPECT_TRUE(importGltf("test.glb", builder.glb(), {.scene = "0"}).environmentMap.has_value());
    EXPECT_FALSE(importGltf("test.glb", builder.glb(), {.scene = "1"}).environmentMap.has_value());
}

TEST(GltfImageLight, LightBeyondAllBoundsIsLimitedAndFinite) {
    GltfBuilder builder = lit(std::vector<uint32_t>(6, 0xFF00FF00));
    lightOf(builder)["intensity"] = 1e39;
    const Scene scene = builder.import();
    EXPECT_EQ(warningsWith(scene, "has an intensity of 1e+39"), 1);
    for (const glm::vec3& pixel : scene.environmentMap.value().image.pixels)
        ASSERT_TRUE(std::isfinite(pixel.x) && std::isfinite(pixel.y) && pixel.y <= 1e15f);
}

// Two coefficients of l = 2, each of which is larger than a double once it is divided.
TEST(GltfImageLight, CoefficientsBeyondAllBoundsAreLimitedAndFinite) {
    GltfBuilder builder = lit({0xFF000010});
    Json coefficients = Json::array();
    for (size_t i = 0; i < 9; ++i)
        coefficients.push_back({0.0, 0.0, 0.0});
    coefficients[4] = {1.7e308, 0.0, 0.0};
    coefficients[8] = {-1.7e308, 0.0, 0.0};
    lightOf(builder)["irradianceCoefficients"] = coefficients;
    const Scene scene = builder.import();
    for (const glm::vec3& pixel : scene.environmentMap.value().image.pixels)
        ASSERT_TRUE(pixel.x >= 0.0f && pixel.x <= 1e15f);
}

} // namespace
} // namespace lavalight::test
