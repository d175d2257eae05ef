// Scenes far from where the world's coordinates count from, in pictures: a closed room stays closed, and all
// places that people write or read are the world's.
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "image/exr.h"
#include "support/mean_test.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;
using Words = std::vector<std::string>;

const std::string kField = std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/";

// The closed grey room at the origin, whose root is node 4.
GltfBuilder room() {
    const std::string file = readFile(kField + "room.glb");
    uint32_t length = 0;
    std::memcpy(&length, file.data() + 12, sizeof length);
    GltfBuilder builder;
    builder.json = json::parse(file.substr(20, length));
    builder.bytes = file.substr(28 + length);
    return builder;
}

// The walls' corners lie at whole metres, which single precision holds there; what is finer keeps a node.
GltfBuilder roomOfFarVertices(const glm::vec3& place) {
    GltfBuilder builder = room();
    const json& view = builder.json["bufferViews"][0];
    for (size_t i = 0; i < view["byteLength"].get<size_t>() / sizeof(glm::vec3); ++i) {
        glm::vec3 corner;
        char* const at = builder.bytes.data() + i * sizeof corner;
        std::memcpy(&corner, at, sizeof corner);
        corner += place;
        std::memcpy(at, &corner, sizeof corner);
    }
    builder.json["accessors"][0].erase("min");
    builder.json["accessors"][0].erase("max");
    for (const size_t node : {1, 2})
        builder.json["nodes"][node]["translation"] = {place.x, place.y, place.z};
    builder.json["nodes"][3]["translation"] = {place.x, place.y, place.z + 0.95};
    return builder;
}

class FarFromOrigin : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const Words& words) const { return runLavalight(words, folder_.path()); }

    // A red sky around the room; no ray may find it.
    [[nodiscard]] ExrFile render(const std::string& scene, const std::string& seed,
                                 const Words& more = {}) const {
        Words words{"render", scene,    "--env", "5,0,0", "--size",  "64x64",     "--spp",
                    "64",     "--seed", seed,    "-o",    "out.exr", "--sampler", "independent"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return readExr(folder_ / "out.exr");
    }

    // The file's name.
    [[nodiscard]] std::string write(const GltfBuilder& builder) const {
        writeFileAtomically(folder_ / "s.glb", builder.glb());
        return "s.glb";
    }

    [[nodiscard]] std::string write(const json& translation) const {
        GltfBuilder builder = room();
        builder.json["nodes"][4]["translation"] = translation;
        return write(builder);
    }

    const TemporaryFolder folder_;
};

// glTF 2.0, 3.5.3: a node's transform moves all that is below it, the camera with the room. Moved alike,
// they make the same picture; in a closed room no pixel has more red than green.
TEST_F(FarFromOrigin, ClosedRoomGivesThePictureOfTheRoomAtTheOrigin) {
    const ExrFile near = render(kField + "room.glb", "1");
    const auto expectSame = [&](const std::string& scene, const char* way) {
        const ExrFile far = render(scene, "2");
        const test::MeanComparison comparison = test::compareMeans(far, near);
        EXPECT_TRUE(comparison.same()) << way << ": " << comparison.text();
        EXPECT_GT(comparison.share, 0.5) << way;
        size_t leaks = 0;
        for (const glm::vec3& p : far.radiance().pixels)
            leaks += p.r > 1.001f * p.g ? 1 : 0;
        EXPECT_EQ(leaks, 0u) << way;
    };
    expectSame(kField + "room_1e5.glb", "field 09");
    expectSame(write({1e7, 2e7, -1e7}), "translation");
    expectSame(write(roomOfFarVertices({1e7f, 5e6f, -1e7f})), "vertices");
}

TEST_F(FarFromOrigin, PlacesOfOptionsAndResultsAreTheWorlds) {
    const std::string scene = write({1e7, 2e7, -1e7});
    const Words view{"--look-from", "10000000.25,20000000.125,-9999999.25", "--look-at", "1e7,2e7,-1e7"};
    const ExrFile far = render(scene, "2", view);
    const ExrFile near =
        render(kField + "room.glb", "1", {"--look-from", "0.25,0.125,0.75", "--look-at", "0,0,0"});
    const test::MeanComparison comparison = test::compareMeans(far, near);
    EXPECT_TRUE(comparison.same()) << comparison.text();
    const auto valueOf = [&](const std::string& key) {
        for (const auto& [name, value] : far.metadata)
            if (name == key)
                return value;
        return std::string();
    };
    EXPECT_EQ(valueOf("option:look-from"), "10000000.25,20000000.125,-9999999.25");
    EXPECT_EQ(valueOf("origin"), "10000000,20000000,-10000000");

    const json info = json::parse(run({"info", scene, "--json"}).out);
    EXPECT_EQ(info.at("origin"), json({1e7, 2e7, -1e7}));
    EXPECT_EQ(info.at("bounds").at("lower"), json({9999999.0, 19999999.0, -10000001.0}));
    EXPECT_NEAR(info.at("cameras").at(0).at("position").at(2).get<double>(), -9999999.05, 1e-6);
    const std::string text = run({"info", scene}).out;
    EXPECT_NE(text.find("at (10000000, 20000000, -9999999.05)\n"), std::string::npos) << text;

    const json path = json::parse(run({"trace", scene, "--pixel", "10,63", "--size", "64x64"}).out);
    const json& position = path.at("vertices").at(0).at("position");
    EXPECT_NEAR(position.at(1).get<double>(), 2e7 - 1.0, 1e-6) << position; // the floor
}

// An unlit tile that flies away from where the first frame's camera stands: by so far that the second frame
// counts from elsewhere.
TEST_F(FarFromOrigin, CameraThatStandsInForAnAnimationStaysWhileTheOriginMoves) {
    GltfBuilder builder;
    const int tile = builder.addMesh(
        {{"attributes", {{"POSITION", builder.addVec3({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}})}}},
         {"material", 0}});
    builder.json["materials"] = {{{"extensions", {{"KHR_materials_unlit", json::object()}}}}};
    builder.addNode({{"mesh", tile}});
    const int times = builder.addAccessor({{"bufferView", builder.addView<float>({0.0f, 1.0f})},
                                           {"componentType", 5126},
                                           {"count", 2},
                                           {"type", "SCALAR"}});
    const int places = builder.addVec3({{0, 0, 0}, {-60, -45, -100}}); // along the view
    builder.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const std::string scene = write(builder);
    const auto meanOf = [&](Words words) {
        for (const char* word : {"--env", "0,0,0", "--size", "128x128", "--spp", "16", "-o", "out.exr"})
            words.emplace_back(word);
        EXPECT_EQ(run(words).exitCode, 0);
        const std::string file = words[2] == "--frames" ? "out_0001.exr" : "out.exr";
        double sum = 0.0;
        for (const glm::vec3& p : readExr(folder_ / file).radiance().pixels)
            sum += p.g;
        return sum;
    };
    const json first = json::parse(run({"info", scene, "--json"}).out);
    EXPECT_EQ(first.at("origin"), json({0.0, 0.0, 0.0}));
    EXPECT_NE(json::parse(run({"info", scene, "--at", "1", "--json"}).out).at("origin"), first.at("origin"));
    const auto text = [](const json& p, const json& way) {
        std::string words;
        for (const size_t axis : {0, 1, 2})
            words += std::to_string(p[axis].get<double>() + way[axis].get<double>()) + (axis < 2 ? "," : "");
        return words;
    };
    const json& camera = first.at("cameras").at(0);
    const double expected =
        meanOf({"render", scene, "--at", "1", "--look-from", text(camera["position"], {0.0, 0.0, 0.0}),
                "--look-at", text(camera["position"], camera["forward"])});
    EXPECT_GT(expected, 1.0);
    EXPECT_NEAR(meanOf({"render", scene, "--frames", "0:2", "--fps", "1"}), expected, 0.2 * expected);
}

// Two rooms 10,000 km apart: one of them is as good as alone, the other is told of and in the bias ledger.
TEST_F(FarFromOrigin, WhatSinglePrecisionCannotHoldIsWarnedOfAndEntersTheLedger) {
    GltfBuilder builder = room();
    builder.addNode({{"mesh", 0}, {"translation", {1e7, 0, 0}}});
    builder.json["scenes"][0]["nodes"].push_back(5);
    const ProgramResult result = run({"render", write(builder), "--size", "16x16", "--spp", "1", "--report",
                                      "out.json", "-o", "out.exr", "--env", "1,1,1"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(
        result.err.find("1e+07 m from this scene's origin, (0, 0, 0), positions are rounded to steps of 1 m"),
        std::string::npos)
        << result.err;
    const json ledger = json::parse(readFile(folder_ / "out.json")).at("ledger");
    ASSERT_EQ(ledger.size(), 1u) << ledger;
    EXPECT_EQ(ledger.at(0).at("cause"), "coarse-geometry");
    EXPECT_EQ(
        ledger.at(0).at("detail"),
        "positions 1e+07 m from the scene's origin are rounded to steps of 1 m, where something is 2 m wide");
}

} // namespace
} // namespace lavalight
