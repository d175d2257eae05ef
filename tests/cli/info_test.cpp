// `lavalight info`: what it says of scenes, and how it refuses what is none.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

// One triangle seen by no camera; uses an extension that nobody knows. The buffer holds (0 0 0) (1 0 0) (0 1
// 0).
constexpr const char* kTriangle = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["EXT_unheard_of", "KHR_materials_emissive_strength"],
  "extensions": {"EXT_unheard_of": {}},
  "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"name": "tri", "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
  "materials": [{"emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
})";

class Info : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }

    void expectRefusal(const std::string& path, const std::string& part) const {
        const ProgramResult result = run({"info", path});
        EXPECT_EQ(result.exitCode, 1) << path;
        EXPECT_EQ(result.out, "") << path;
        EXPECT_TRUE(result.err.starts_with("lavalight: error: ")) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }

    const TemporaryFolder folder_;
};

TEST_F(Info, CountsWhatTheFileHolds) {
    writeFileAtomically(folder_ / "triangle.gltf", kTriangle);
    const ProgramResult result = run({"info", "triangle.gltf", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const json info = json::parse(result.out);
    EXPECT_EQ(info.at("triangles"), 1);
    EXPECT_EQ(info.at("emissiveTriangles"), 1);
    EXPECT_EQ(info.at("vertices"), 3);
    EXPECT_EQ(info.at("meshes"), 1);
    EXPECT_EQ(info.at("cameras").size(), 1u); // the camera that frames the scene
    EXPECT_EQ(info.at("bounds").at("lower"), json({0.0, 0.0, 0.0}));
    EXPECT_EQ(info.at("bounds").at("upper"), json({1.0, 1.0, 0.0}));
    EXPECT_GE(info.at("geometryBytes"), 3 * 12 + 12);
}

TEST_F(Info, ListsTheDefaultMaterialOnlyWhereAPrimitiveHasNoOther) {
    json gltf = json::parse(kTriangle);
    gltf["materials"][0]["name"] = "lamp";
    const auto namesIn = [&] {
        writeFileAtomically(folder_ / "named.gltf", gltf.dump());
        const json info = json::parse(run({"info", "named.gltf", "--json"}).out);
        std::vector<std::string> names;
        for (const json& material : info.at("materials"))
            names.push_back(material.at("name"));
        return names;
    };
    EXPECT_EQ(namesIn(), std::vector<std::string>{"lamp"});
    gltf["meshes"][0]["primitives"][0].erase("material");
    EXPECT_EQ(namesIn(), (std::vector<std::string>{"lamp", "default"}));
}

TEST_F(Info, ListsTheLightsWithoutSize) {
    json gltf = json::parse(kTriangle);
    gltf["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf["extensions"] = {{"KHR_lights_punctual",
                           {{"lights",
                             {{{"type", "spot"},
                               {"name", "lamp"},
                               {"intensity", 3.0},
                               {"spot", {{"innerConeAngle", 0.0}, {"outerConeAngle", 0.5235987755982988}}}},
                              {{"type", "directional"}, {"name", "sun"}, {"color", {1.0, 0.5, 0.25}}}}}}}};
    gltf["nodes"].push_back(
        {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    gltf["scenes"][0]["nodes"] = {0, 1, 2};
    writeFileAtomically(folder_ / "lit.gltf", gltf.dump());
    const std::string text = run({"info", "lit.gltf"}).out;
    EXPECT_NE(text.find("\"lamp\": spot"), std::string::npos) << text;
    const json lights = json::parse(run({"info", "lit.gltf", "--json"}).out).at("punctualLights");
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights.at(0).at("position"), json({1, 2, 3}));
    EXPECT_EQ(lights.at(0).at("direction"), json({0, 0, -1}));
    EXPECT_NEAR(lights.at(0).at("outerConeDegrees").get<double>(), 30.0, 1e-4);
    EXPECT_EQ(lights.at(1).at("kind"), "directional");
    EXPECT_EQ(lights.at(1).at("intensity"), json({1.0, 0.5, 0.25}));
    EXPECT_FALSE(lights.at(1).contains("position"));
}

TEST_F(Info, NamesTheExtensionsThatItIgnores) {
    writeFileAtomically(folder_ / "triangle.gltf", kTriangle);
    const json info = json::parse(run({"info", "triangle.gltf", "--json"}).out);
    EXPECT_EQ(info.at("extensionsUsed"), json({"EXT_unheard_of", "KHR_materials_emissive_strength"}));
    EXPECT_EQ(info.at("extensionsIgnored"), json::array({"EXT_unheard_of"}));
    const auto& warnings = info.at("warnings");
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const json& warning) {
        return warning.get<std::string>().find("EXT_unheard_of") != std::string::npos;
    })) << warnings;
}

TEST_F(Info, TheTextNamesEveryFigureOfTheJson) {
    const ProgramResult result = run({"info", "cornell-box"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    for (const char* word : {"triangles", "emissive triangles", "meshes", "materials", "camera", "bounds",
                             "geometry memory", "solids", "extensions used", "extensions ignored"})
        EXPECT_NE(result.out.find(word), std::string::npos) << word;
}

TEST_F(Info, TheBuiltInCornellBoxIsUnderstoodWithoutWarnings) {
    const ProgramResult result = run({"info", "cornell-box", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const json info = json::parse(result.out);
    EXPECT_GE(info.at("triangles"), 30);
    EXPECT_GE(info.at("emissiveTriangles"), 2);
    EXPECT_EQ(info.at("warnings"), json::array());
    EXPECT_EQ(info.at("extensionsIgnored"), json::array());
}

TEST_F(Info, PathsThatAreNoSceneAreOneLineAndExitOne) {
    writeFileAtomically(folder_ / "empty.glb", "");
    writeFileAtomically(folder_ / "text.glb", "this is no scene");
    writeFileAtomically(folder_ / "text.gltf", "this is no scene");
    expectRefusal("none.glb", "none.glb");
    expectRefusal(".", "directory");
    expectRefusal("empty.glb", "empty.glb");
    expectRefusal("text.glb", "text.glb");
    expectRefusal("text.gltf", "text.gltf");
    expectRefusal("cornell-bx", "cornell-bx");
}

TEST_F(Info, WithoutASceneTheUsageIsWrong) {
    const ProgramResult result = run({"info"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("input is required"), std::string::npos) << result.err;
}

TEST_F(Info, RealScenesAreValidJson) {
    const char* assets = std::getenv("LAVALIGHT_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "LAVALIGHT_ASSETS is not set";
    const std::filesystem::path box =
        std::filesystem::path(assets) / "CornellBox-Bitterli/CornellBox-Bitterli.glb";
    const ProgramResult result = run({"info", box.string(), "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_GT(json::parse(result.out).at("triangles"), 0);
    EXPECT_GT(json::parse(result.out).at("emissiveTriangles"), 0);
}

// The triangle slides from x = 0 to x = 8 in 2 seconds.
std::string slidingTriangle() {
    test::GltfBuilder builder;
    builder.addNode({{"mesh", builder.addTriangle()}});
    const int keys = builder.addVec3({{0, 0, 0}, {8, 0, 0}});
    const int times = builder.addIndices<float>({0, 2}, test::kFloat);
    builder.json["animations"] = {
        {{"name", "slide"},
         {"samplers", {{{"input", times}, {"output", keys}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    return builder.glb();
}

TEST_F(Info, ListsAnimationsAndShowsTheSceneAtTheTimeAskedFor) {
    writeFileAtomically(folder_ / "slide.glb", slidingTriangle());
    const json still = json::parse(run({"info", "slide.glb", "--json"}).out);
    EXPECT_EQ(still.at("animations"), json::parse(R"([{"name": "slide", "seconds": 2.0}])"));
    EXPECT_EQ(still.at("bounds").at("upper").at(0), 1.0);
    const json moved = json::parse(run({"info", "slide.glb", "--json", "--at", "1"}).out);
    EXPECT_EQ(moved.at("bounds").at("upper").at(0), 5.0);
    EXPECT_NE(run({"info", "slide.glb"}).out.find("animation 0          \"slide\": 2 s"), std::string::npos);
}

TEST_F(Info, AnimationsThatAreNotThereAreWrongUsage) {
    writeFileAtomically(folder_ / "slide.glb", slidingTriangle());
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{"info", "slide.glb", "--at", "0", "--animation", "jump"},
                                               {"info", "slide.glb", "--animation", "slide"},
                                               {"info", "slide.glb", "--at", "nan"},
                                               {"info", "cornell-box", "--at", "0"},
                                               {"info", "dense-10", "--at", "0"}}) {
        const ProgramResult result = run(wrong);
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_TRUE(result.err.starts_with("lavalight: error: ")) << result.err;
    }
}

} // namespace
} // namespace lavalight
