// Runs the import over the real and the malformed files that LAVALIGHT_ASSETS points to.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "scene/gltf_import.h"

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

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void expectSound(const Scene& scene) {
    ASSERT_FALSE(scene.cameras.empty());
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_LT(mesh.material, scene.materials.size());
        EXPECT_TRUE(std::all_of(mesh.positions.begin(), mesh.positions.end(), isFinite));
        EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
        EXPECT_TRUE(std::all_of(mesh.normals.begin(), mesh.normals.end(),
                                [](const glm::vec3& n) { return std::abs(glm::length(n) - 1.0f) < 1e-5f; }));
        EXPECT_TRUE(std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
            return std::max({t.x, t.y, t.z}) < mesh.positions.size();
        }));
    }
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
    // Against the specification, or for a reader of glTF 2.1, which they exist to test.
    const std::map<std::string, std::string> refused = {
        {"cube_att.gltf", "is a child of both"}, {"Compatibility_04.gltf", "it needs a reader of glTF 2.1"}};
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
        const std::filesystem::path& path = entry.path();
        const bool isScene = path.extension() == ".gltf" || path.extension() == ".glb";
        if (!isScene || path.string().find("/invalid/") != std::string::npos)
            continue;
        ++files;
        try {
            expectSound(importGltf(path));
        } catch (const Error& error) {
            const auto reason = refused.find(path.filename().string());
            const std::string expected =
                reason == refused.end() ? "it requires the extension" : reason->second;
            EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(files, 100);
}

} // namespace
} // namespace lavalight::test
