// Tests of scenes by name.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"
#include "session/builtin.h"

namespace lavalight::test {
namespace {

std::string loadError(const std::string& name) {
    try {
        static_cast<void>(loadScene(name));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(BuiltinScenes, CornellBoxLoadsWithLightCameraAndWithoutWarnings) {
    const Scene scene = loadScene("cornell-box");
    EXPECT_EQ(scene.source, "cornell-box");
    EXPECT_GT(scene.triangleCount(), 20u);
    EXPECT_NE(scene.cameras.at(0).name, "framing");
    EXPECT_EQ(scene.environment, glm::vec3(0.0f));
    EXPECT_EQ(scene.warnings, std::vector<std::string>());
}

TEST(BuiltinScenes, FlatDenseSceneHasTheTrianglesAndNoNormals) {
    const Scene round = loadScene("dense-5000");
    const Scene flat = loadScene("dense-5000-flat");
    EXPECT_EQ(flat.source, "dense-5000-flat");
    EXPECT_EQ(flat.triangleCount(), round.triangleCount());
    EXPECT_TRUE(std::ranges::all_of(flat.meshes, [](const Mesh& mesh) { return mesh.normals.empty(); }));
    EXPECT_FALSE(std::ranges::all_of(round.meshes, [](const Mesh& mesh) { return mesh.normals.empty(); }));
}

TEST(BuiltinScenes, EveryListedFileLoadsWithACameraOfItsOwnAndWithoutWarnings) {
    for (const std::string& name : builtinNames()) {
        if (name == "dense-N" || name == "dense-N-flat" || name == "lamps-N")
            continue;
        ASSERT_EQ(loadError(name), "") << name;
        const Scene scene = loadScene(name);
        EXPECT_EQ(scene.source, name);
        EXPECT_GT(scene.triangleCount(), 0u) << name;
        EXPECT_NE(scene.cameras.at(0).name, "framing") << name;
        EXPECT_EQ(scene.warnings, std::vector<std::string>()) << name;
        EXPECT_TRUE(scene.hasOwnLight) << name;
    }
}

TEST(BuiltinScenes, GlassOfTheBuiltInFilesIsSolid) {
    for (const char* name : {"cornell-glass", "glass-caustic"}) {
        const Scene scene = loadScene(name);
        EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(),
                                [](const Material& material) {
                                    return material.transmission == 1.0f && material.isSolid;
                                }),
                  1)
            << name;
    }
}

TEST(BuiltinScenes, DenseScenesHaveAboutTheirNumberOfTriangles) {
    EXPECT_NEAR(static_cast<double>(loadScene("dense-20000").triangleCount()), 20000.0, 200.0);
}

TEST(BuiltinScenes, LampsAreAsManyAsAskedForAndShineDownwards) {
    const Scene scene = loadScene("lamps-1000");
    const Mesh& lamps = scene.meshes.back();
    EXPECT_EQ(lamps.triangles.size(), 1000u);
    EXPECT_GT(scene.materials[lamps.material].emission.r, 0.0f);
    for (const glm::uvec3& t : lamps.triangles) {
        const glm::vec3 v0 = lamps.positions[t.x];
        ASSERT_LT(glm::cross(lamps.positions[t.y] - v0, lamps.positions[t.z] - v0).y, 0.0f);
        for (const uint32_t corner : {t.x, t.y, t.z}) {
            const glm::vec3& p = lamps.positions[corner];
            ASSERT_EQ(glm::clamp(p, scene.bounds.lower, scene.bounds.upper), p);
        }
    }
}

TEST(BuiltinScenes, UnknownNamesListTheKnownOnes) {
    for (const char* name :
         {"cornel-box", "dense-", "dense-12x", "dense--5", "lamps-", "missing/scene.gltf", ""}) {
        const std::string error = loadError(name);
        EXPECT_NE(error.find("(built in: cornell-box, "), std::string::npos) << error;
        EXPECT_NE(error.find(name), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
    EXPECT_NE(loadError("dense-4000000000").find("at most"), std::string::npos);
    EXPECT_NE(loadError("lamps-0").find("1 to 1000000"), std::string::npos);
}

} // namespace
} // namespace lavalight::test
