// Runs the import over the real and the malformed files that LAVALIGHT_ASSETS points to.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "base/error.h"
#include "gltf/import.h"
#include "image/basis_universal.h"
#include "support/sound_scene.h"

namespace lavalight::test {
namespace {

class Assets : public ::testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("LAVALIGHT_ASSETS");
        if (folder == nullptr)
            GTEST_SKIP() << "LAVALIGHT_ASSETS is not set: no assets to import";
        folder_ = folder;
    }

    std::filesystem::path folder_;
};

// "load", or the message.
std::string importResult(const std::filesystem::path& path) {
    try {
        static_cast<void>(importGltf(path));
        return "load";
    } catch (const Error& error) {
        return error.what();
    }
}

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_NEAR(glm::length(a - b), 0.0f, 1e-5f) << a.x << " " << a.y << " " << a.z;
}

TEST_F(Assets, GeneratedMalformedFilesLoadOrFailAsTheirManifestSays) {
    const std::filesystem::path generated = folder_ / "invalid" / "generated";
    std::ifstream manifest(generated / "MANIFEST.tsv");
    ASSERT_TRUE(manifest);
    std::string line;
    std::getline(manifest, line); // the header
    int files = 0;
    while (std::getline(manifest, line)) {
        std::istringstream columns(line);
        std::string name;
        std::string expected;
        std::getline(columns, name, '\t');
        std::getline(columns, expected, '\t');
        const std::filesystem::path path = generated / name;
        if (path.extension() != ".gltf" && path.extension() != ".glb")
            continue; // environment maps
        ++files;
        const std::string result = importResult(path);
        if (name.ends_with("acc_count_zero.glb"))
            expected = "load"; // common in files of exporters: what is empty is left out, with a warning
        if (expected == "load") {
            EXPECT_EQ(result, "load") << line;
        } else if (expected == "error") {
            EXPECT_NE(result, "load") << line;
        }
        EXPECT_EQ(result.find('\n'), std::string::npos) << line;
    }
    EXPECT_GT(files, 60);
}

TEST_F(Assets, RealScenesLoadOrNameTheFeatureThatTheyRequire) {
    // These are against the specification, or for a reader of glTF 2.1, which they exist to test.
    const std::map<std::string, std::string> refused = {
        {"cube_att.gltf", "is a child of both"},
        {"Compatibility_04.gltf", "it needs a reader of glTF 2.1"},
        {"MeshoptCubeTest.gltf", "(KHR_meshopt_compression) uses the filter \"COLOR\""}};
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
        const std::filesystem::path& path = entry.path();
        const bool isScene = path.extension() == ".gltf" || path.extension() == ".glb";
        if (!isScene || path.string().find("/invalid/") != std::string::npos)
            continue;
        ++files;
        try {
            EXPECT_EQ(unsoundPart(importGltf(path)), "") << path;
        } catch (const Error& error) {
            const auto reason = refused.find(path.filename().string());
            const std::string expected =
                reason == refused.end() ? "it requires the extension" : reason->second;
            EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(files, 100);
}

TEST_F(Assets, AnimatedScenesAreSoundAtEveryTime) {
    int animated = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
        const std::filesystem::path& path = entry.path();
        const bool isScene = path.extension() == ".gltf" || path.extension() == ".glb";
        if (!isScene || path.string().find("/invalid/") != std::string::npos ||
            importResult(path) != "load" || importGltf(path).animations.empty())
            continue;
        ++animated;
        const Scene still = importGltf(path);
        for (size_t i = 0; i < still.animations.size(); ++i) {
            const double seconds = 0.37 * static_cast<double>(still.animations[i].seconds);
            const Scene scene = importGltf(path, {.seconds = seconds, .animation = std::to_string(i)});
            EXPECT_EQ(unsoundPart(scene), "") << path;
            EXPECT_GT(2 * scene.triangleCount() + 1, still.triangleCount()) << path;
        }
    }
    EXPECT_GT(animated, 30);
}

TEST_F(Assets, LampHasItsFivePointLights) {
    const Scene scene = importGltf(folder_ / "LightsPunctualLamp/glTF/LightsPunctualLamp.gltf");
    ASSERT_EQ(scene.punctualLights.size(), 5u);
    const PunctualLight& first = scene.punctualLights[0];
    EXPECT_EQ(first.name, "Point");
    EXPECT_EQ(first.kind, PunctualKind::point);
    expectNear(first.intensity, 15.0f * glm::vec3(1.0f, 0.63187498f, 0.23909976f));
    EXPECT_TRUE(std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
        return material.transmission == 1.0f && !material.isSolid; // a shade, not a body
    }));
}

TEST_F(Assets, FourSpotLightsShineTheWaysThatTheirNamesSay) {
    const Scene scene = importGltf(folder_ / "SpotLights/four_spotlights.glb");
    ASSERT_EQ(scene.punctualLights.size(), 4u);
    const glm::vec3 ways[] = {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}}; // Blender's z is glTF's y
    for (size_t i = 0; i < 4; ++i) {
        const PunctualLight& light = scene.punctualLights[i];
        EXPECT_EQ(light.kind, PunctualKind::spot);
        expectNear(light.direction, ways[i]);
        expectNear(light.position, {0, 1, 0});
        EXPECT_FLOAT_EQ(light.intensity.x, 54351.41306588226f);
        EXPECT_FLOAT_EQ(light.outerConeAngle, 0.6544984579086304f);
    }
}

TEST_F(Assets, SphereIsLitByOneLightOfEachKindAndASpotOfDefaults) {
    const Scene scene = importGltf(folder_ / "draco-testdata/sphere_lights.gltf");
    ASSERT_EQ(scene.punctualLights.size(), 4u); // in the order of the nodes
    EXPECT_EQ(scene.punctualLights[0].kind, PunctualKind::spot);
    EXPECT_EQ(scene.punctualLights[0].name, "Blue Lightsaber");
    EXPECT_EQ(scene.punctualLights[1].kind, PunctualKind::directional);
    expectNear(scene.punctualLights[1].intensity, glm::vec3(0.9f));
    EXPECT_EQ(scene.punctualLights[2].kind, PunctualKind::spot);
    EXPECT_EQ(scene.punctualLights[2].intensity, glm::vec3(1.0f));
    EXPECT_EQ(scene.punctualLights[3].kind, PunctualKind::point);
}

TEST_F(Assets, SunIsOfUnitDirectionAndEndsTheStandInForLight) {
    const Scene scene = importGltf(folder_ / "Classroom-Bitterli/Classroom-Bitterli.glb");
    ASSERT_EQ(scene.punctualLights.size(), 1u);
    EXPECT_EQ(scene.punctualLights[0].kind, PunctualKind::directional);
    expectNear(scene.punctualLights[0].direction, {0.8658039f, -0.4167660f, 0.2769290f});
    EXPECT_EQ(scene.environment, glm::vec3(0.0f));
}

TEST_F(Assets, ExtensionDeclaredWithoutLightsIsTolerated) {
    const Scene scene = importGltf(folder_ / "CornellBox-nvpro/cornellBox.gltf");
    EXPECT_TRUE(scene.punctualLights.empty());
    EXPECT_EQ(scene.ignoredExtensions, std::vector<std::string>{"NV_materials_mdl"});
}

TEST_F(Assets, GlassOfTheLivingRoomIsSolidAndClear) {
    const Scene scene = importGltf(folder_ / "LivingRoom-Bitterli/LivingRoom-Bitterli.glb");
    const Material& glass = scene.materials.at(14);
    EXPECT_EQ(glass.transmission, 1.0f);
    EXPECT_TRUE(glass.isSolid);
    EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(),
                            [](const Material& material) { return material.isSolid; }),
              1);
    for (const std::string& warning : scene.warnings)
        EXPECT_EQ(warning.find("attenuation"), std::string::npos) << warning;
}

// Every row of cubes is compressed in another way; the first is not. Columns are of one kind.
TEST_F(Assets, EveryCubeOfMeshoptCubeTestIsTheOneAboveIt) {
    if (MESHOPTIMIZER_VERSION < 1000)
        GTEST_SKIP() << "built with a meshoptimizer that does not know codec 1";
    const Scene scene = importGltf(folder_ / "meshopt-samples/MeshoptCubeTest/MeshoptCubeTest.gltf");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    std::vector<const Mesh*> cubes;
    for (const Mesh& mesh : scene.meshes)
        if (mesh.name.starts_with("Cube_"))
            cubes.push_back(&mesh);
    ASSERT_EQ(cubes.size(), 25u);
    for (size_t i = 5; i < cubes.size(); ++i) {
        const Mesh& mesh = *cubes[i];
        const Mesh& plain = *cubes[i % 5];
        ASSERT_EQ(mesh.positions.size(), plain.positions.size()) << mesh.name;
        ASSERT_EQ(mesh.colors.size(), plain.colors.size()) << mesh.name;
        const glm::vec3 apart = mesh.positions.front() - plain.positions.front();
        for (size_t v = 0; v < mesh.positions.size(); ++v) {
            EXPECT_LT(glm::length(mesh.positions[v] - plain.positions[v] - apart), 1e-3f) << mesh.name;
            EXPECT_LT(glm::length(mesh.normals[v] - plain.normals[v]), 0.02f) << mesh.name;
            const float color = mesh.colors.empty() ? 0.0f : glm::length(mesh.colors[v] - plain.colors[v]);
            EXPECT_LT(color, 0.02f) << mesh.name;
        }
    }
}

// The mean of a channel of the base colour's picture.
double meanOf(const Scene& scene, size_t material, size_t channel) {
    const std::optional<Texture>& texture = scene.materials.at(material).texture(TextureSlot::baseColor);
    const Picture& picture = scene.pictures.at(texture.value().picture);
    double sum = 0.0;
    for (size_t i = channel; i < picture.bytes.size(); i += 4)
        sum += picture.bytes[i];
    return sum / (picture.bytes.size() / 4.0);
}

TEST_F(Assets, LampInKtx2HasTheColorsOfTheOneInJpeg) {
    if (!hasBasisUniversal())
        GTEST_SKIP() << "built without Basis Universal";
    const Scene ktx2 = importGltf(folder_ / "AnisotropyBarnLamp/glTF-KTX2-Basisu/AnisotropyBarnLamp.gltf");
    const Scene jpeg = importGltf(folder_ / "AnisotropyBarnLamp/glTF-noKTX/AnisotropyBarnLamp.gltf");
    ASSERT_EQ(ktx2.pictures.size(), 4u);
    ASSERT_EQ(jpeg.pictures.size(), 4u);
    for (size_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(meanOf(ktx2, 0, channel), meanOf(jpeg, 0, channel), 4.0) << channel;
}

} // namespace
} // namespace lavalight::test
