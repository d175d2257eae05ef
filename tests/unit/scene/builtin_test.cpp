// Tests of scenes by name.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"
#include "scene/builtin.h"

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

TEST(BuiltinScenes, EveryListedFileNameLoads) {
    for (const std::string& name : builtinNames())
        EXPECT_EQ(loadError(name == "dense-N" ? "dense-6000" : name), "") << name;
}

TEST(BuiltinScenes, DenseScenesHaveAboutTheirNumberOfTriangles) {
    EXPECT_NEAR(static_cast<double>(loadScene("dense-20000").triangleCount()), 20000.0, 200.0);
}

TEST(BuiltinScenes, UnknownNamesListTheKnownOnes) {
    for (const char* name : {"cornel-box", "dense-", "dense-12x", "dense--5", "missing/scene.gltf", ""}) {
        const std::string error = loadError(name);
        EXPECT_NE(error.find("(built in: cornell-box, "), std::string::npos) << error;
        EXPECT_NE(error.find(name), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
    EXPECT_NE(loadError("dense-4000000000").find("at most"), std::string::npos);
}

} // namespace
} // namespace lavalight::test
