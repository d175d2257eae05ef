// What a camera of a file shows: all that it frames, between its planes, of the scene that is asked for
// (glTF 2.0, 3.10.3 and 3.5.1).
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "image/exr.h"
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

// Unlit quads of width 1 in a row at `z`, red, green, blue, white from the left; they fill 4 x 1 metres.
void addTiles(GltfBuilder& builder, float z) {
    const std::vector<json> colours{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    for (size_t i = 0; i < colours.size(); ++i) {
        const float x = static_cast<float>(i) - 2.0f;
        const int positions =
            builder.addVec3({{x, -0.5f, z}, {x + 1, -0.5f, z}, {x + 1, 0.5f, z}, {x, 0.5f, z}});
        const int indices = builder.addIndices<uint16_t>({0, 1, 2, 0, 2, 3}, 5123);
        builder.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", colours[i]}}},
                                             {"extensions", {{"KHR_materials_unlit", json::object()}}}});
        builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}}},
                                                   {"indices", indices},
                                                   {"material", builder.json["materials"].size() - 1}})}});
    }
}

json orthographic(double xmag, double ymag, double znear = 0.01, double zfar = 100.0) {
    return {{"type", "orthographic"},
            {"orthographic", {{"xmag", xmag}, {"ymag", ymag}, {"znear", znear}, {"zfar", zfar}}}};
}

// A camera whose height at distance 5 is 1, and which is four times as wide.
json perspective() {
    return {{"type", "perspective"},
            {"perspective", {{"yfov", 2.0 * std::atan(0.1)}, {"aspectRatio", 4.0}, {"znear", 0.01}}}};
}

class CameraFrame : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult render(const std::string& file, const Words& more) const {
        Words arguments{"render", file, "--env", "0,0,0", "--spp", "4", "-o", "out.exr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        ProgramResult result = runLavalight(arguments, folder_.path());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result;
    }

    [[nodiscard]] Image image() const { return readExr(folder_ / "out.exr").radiance(); }

    // How many tiles the picture shows: their colours are all of 0 and 1.
    [[nodiscard]] size_t tilesSeen() const {
        std::set<int> colours;
        for (const glm::vec3& p : image().pixels)
            if (p == glm::round(p) && p != glm::vec3(0.0f))
                colours.insert(static_cast<int>(4 * p.x + 2 * p.y + p.z));
        return colours.size();
    }

    void write(const GltfBuilder& builder) const { writeFileAtomically(folder_ / "s.glb", builder.glb()); }

    const TemporaryFolder folder_;
};

TEST_F(CameraFrame, AllThatItFramesStaysInThePictureWhateverItsShape) {
    for (const char* size : {"64x64", "32x64", "128x32", "200x20"}) {
        (void)render(kField + "ortho.glb", {"--size", size});
        EXPECT_EQ(tilesSeen(), 4u) << size;
    }
    GltfBuilder builder;
    addTiles(builder, 0.0f);
    builder.json["cameras"] = json::array({perspective()});
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 5}}});
    write(builder);
    for (const char* size : {"64x64", "32x64", "128x32", "200x20"}) {
        (void)render("s.glb", {"--size", size});
        EXPECT_EQ(tilesSeen(), 4u) << size;
    }
}

// The tiles fill the width, and so a quarter of the height of a square.
TEST_F(CameraFrame, MoreHeightIsShownAndNothingStretched) {
    (void)render(kField + "ortho.glb", {"--size", "64x64"});
    const Image square = image();
    for (uint32_t y = 0; y < 64; ++y)
        for (uint32_t x = 0; x < 64; ++x)
            EXPECT_EQ(square.at(x, y) != glm::vec3(0.0f), y >= 24 && y < 40) << x << ", " << y;
}

TEST_F(CameraFrame, HeightIsKeptWhereNothingIsCropped) {
    (void)render(kField + "ortho.glb", {"--size", "160x32"});
    const Image wide = image();
    for (uint32_t y = 0; y < 32; ++y) {
        EXPECT_NE(wide.at(80, y), glm::vec3(0.0f));
        EXPECT_EQ(wide.at(10, y), glm::vec3(0.0f)); // a tenth of the width on either side is empty
    }
}

TEST_F(CameraFrame, FovThatIsAskedForIsTheHeightOfAnyPicture) {
    GltfBuilder builder;
    addTiles(builder, 0.0f);
    builder.json["cameras"] = json::array({perspective()});
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 5}}});
    write(builder);
    (void)render("s.glb", {"--size", "64x64", "--fov", "11.42"}); // 1 m high
    EXPECT_EQ(tilesSeen(), 2u);
}

TEST_F(CameraFrame, CameraThatStandsInFramesTheSceneInUprightPictures) {
    GltfBuilder builder;
    addTiles(builder, 0.0f);
    write(builder);
    for (const char* size : {"64x64", "16x128", "128x16"}) {
        (void)render("s.glb", {"--size", size});
        EXPECT_EQ(tilesSeen(), 4u) << size;
    }
}

TEST_F(CameraFrame, WallBeforeTheNearPlaneLetsTheCameraLookIntoTheRoom) {
    (void)render(kField + "znear.glb", {"--size", "64x64"});
    EXPECT_EQ(tilesSeen(), 4u);
    EXPECT_EQ(image().at(32, 4), glm::vec3(0.0f)); // above the tiles
    (void)render(kField + "znear.glb", {"--size", "64x64", "--no-clip"});
    EXPECT_EQ(image().at(32, 4), glm::vec3(1.0f)); // the wall
}

TEST_F(CameraFrame, WhatIsBeyondTheFarPlaneIsHiddenAndSaidToBe) {
    const ProgramResult cut = render(kField + "zfar.glb", {"--size", "64x64", "--report", "r.json"});
    EXPECT_EQ(tilesSeen(), 0u);
    EXPECT_NE(cut.err.find("zfar of 3 m, which hides 8 triangles"), std::string::npos) << cut.err;
    EXPECT_NE(readFile(folder_ / "r.json").find("zfar of 3 m"), std::string::npos);
    const ProgramResult whole = render(kField + "zfar.glb", {"--size", "64x64", "--no-clip"});
    EXPECT_EQ(tilesSeen(), 4u);
    EXPECT_EQ(whole.err.find("zfar"), std::string::npos) << whole.err;
    const ProgramResult clear = render(kField + "znear.glb", {"--size", "64x64"}); // zfar 100
    EXPECT_EQ(clear.err.find("zfar"), std::string::npos) << clear.err;
}

// Planes are flat: of tiles at 1, 2 and 5 m, those at 2 m are seen to their ends, 2.7 m from the camera, with
// planes at 1.99 and 2.01 m.
TEST_F(CameraFrame, DistancesToPlanesAreAlongTheDirectionOfView) {
    GltfBuilder builder;
    for (const float z : {1.0f, 0.0f, -3.0f})
        addTiles(builder, z);
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 2}}});
    const auto renderBetween = [&](double znear, double zfar, const Words& more) {
        builder.json["cameras"] = json::array(
            {{{"type", "perspective"},
              {"perspective", {{"yfov", 1.5}, {"aspectRatio", 1.0}, {"znear", znear}, {"zfar", zfar}}}}});
        write(builder);
        Words arguments{"--size", "64x64"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        (void)render("s.glb", arguments);
    };
    for (const Words& more : {Words{"--schedule", "fused"}, Words{"--schedule", "wavefront"},
                              Words{"--schedule", "auto"}, Words{"--aperture", "0.001", "--focus", "2"}}) {
        SCOPED_TRACE(more[1]);
        renderBetween(1.99, 2.01, more);
        EXPECT_EQ(tilesSeen(), 4u);
        EXPECT_EQ(image().at(1, 32), glm::vec3(1, 0, 0));  // the end of the red tile
        EXPECT_EQ(image().at(62, 32), glm::vec3(1, 1, 1)); // and of the white one
        EXPECT_NE(image().at(32, 25), glm::vec3(0.0f));    // tiles at 2 m reach 8 rows up,
        EXPECT_EQ(image().at(32, 20), glm::vec3(0.0f));    // those at 1 m would reach 17
        renderBetween(2.005, 2.01, more);
        EXPECT_EQ(tilesSeen(), 0u);
        renderBetween(1.5, 1.995, more);
        EXPECT_EQ(tilesSeen(), 0u);
    }
}

// A white floor and a lamp behind the near plane, which still lights it: planes cut what the camera sees
// only.
TEST_F(CameraFrame, PlanesClipCameraRaysAlone) {
    GltfBuilder builder;
    const int floor = builder.addVec3({{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}});
    const int lamp = builder.addVec3({{-1, -1, 4.5f}, {0, 1, 4.5f}, {1, -1, 4.5f}}); // faces the floor
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}},
                                 {{"emissiveFactor", {1, 1, 1}}}};
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", floor}}}, {"material", 0}})}});
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", lamp}}}, {"material", 1}})}});
    builder.json["materials"][1]["doubleSided"] = true;
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 5}}});
    builder.json["cameras"] = json::array({orthographic(0.1, 0.1)});
    write(builder);
    (void)render("s.glb", {"--size", "8x8"});
    EXPECT_EQ(image().at(4, 4), glm::vec3(1.0f)); // the back of the lamp
    builder.json["cameras"] = json::array({orthographic(0.1, 0.1, 1.0)});
    write(builder);
    (void)render("s.glb", {"--size", "8x8"});
    for (const glm::vec3& pixel : image().pixels) {
        EXPECT_GT(pixel.x, 0.0f); // the floor, lit
        EXPECT_LT(pixel.x, 0.5f);
    }
}

TEST_F(CameraFrame, PlanesWithNothingBetweenThemAreNamedAndLeftOut) {
    GltfBuilder builder;
    addTiles(builder, 0.0f);
    builder.json["cameras"] = json::array({orthographic(2, 2, 5, 1)});
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 5}}});
    write(builder);
    const ProgramResult result = render("s.glb", {"--size", "64x64"});
    EXPECT_NE(result.err.find("clipping planes with nothing between them were left out: camera 0"),
              std::string::npos)
        << result.err;
    EXPECT_EQ(tilesSeen(), 4u);
}

TEST_F(CameraFrame, InfoNamesThePlanes) {
    const ProgramResult text = runLavalight({"info", kField + "zfar.glb"}, folder_.path());
    EXPECT_NE(text.out.find("sees 0.01 m to 3 m"), std::string::npos) << text.out;
    const json camera = json::parse(runLavalight({"info", kField + "zfar.glb", "--json"}, folder_.path()).out)
                            .at("cameras")
                            .at(0);
    EXPECT_NEAR(camera.at("zfar").get<double>(), 3.0, 1e-6);
}

class Scenes : public CameraFrame {};

TEST_F(Scenes, DefaultIsShownAndOthersByNameOrNumber) {
    const auto isThere = [&](const Words& which) {
        Words arguments{"--size", "16x16"};
        arguments.insert(arguments.end(), which.begin(), which.end());
        (void)render(kField + "scenes.gltf", arguments);
        return image().at(8, 8) == glm::vec3(1, 0, 0);
    };
    EXPECT_TRUE(isThere({}));
    EXPECT_FALSE(isThere({"--scene", "0"}));
    EXPECT_TRUE(isThere({"--scene", "1"}));
    EXPECT_TRUE(isThere({"--scene", "second"}));
    (void)render(kField + "scenes.gltf", {"--scene", "second", "--size", "8x8", "--report", "r.json"});
    EXPECT_EQ(json::parse(readFile(folder_ / "r.json")).at("settings").at("scene"), "second");
}

TEST_F(Scenes, UnknownOneIsToldThoseThatThereAre) {
    for (const char* wanted : {"2", "third"}) {
        const ProgramResult result =
            runLavalight({"render", kField + "scenes.gltf", "--scene", wanted}, folder_.path());
        EXPECT_EQ(result.exitCode, 2);
        EXPECT_NE(result.err.find("--scene: "), std::string::npos) << result.err;
        EXPECT_NE(result.err.find("1 \"second\""), std::string::npos) << result.err;
    }
    EXPECT_EQ(runLavalight({"info", "dense-100", "--scene", "0"}, folder_.path()).exitCode, 2);
}

TEST_F(Scenes, InfoListsThemAndSaysWhichItDescribes) {
    const ProgramResult text = runLavalight({"info", kField + "scenes.gltf"}, folder_.path());
    EXPECT_NE(text.out.find("scene 0              \"\"\n"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("scene 1              \"second\", shown\n"), std::string::npos) << text.out;
    const json info = json::parse(
        runLavalight({"info", kField + "scenes.gltf", "--json", "--scene", "0"}, folder_.path()).out);
    EXPECT_EQ(info.at("scenes"), json({"", "second"}));
    EXPECT_EQ(info.at("shownScene"), 0);
    EXPECT_EQ(info.at("triangles"), 0);
}

// The camera that stands in frames the scene that is shown, not all of the file.
TEST_F(Scenes, CameraThatStandsInFramesTheChosenOne) {
    GltfBuilder builder;
    addTiles(builder, 0.0f);
    builder.addNode({{"mesh", 0}, {"translation", {1000, 0, 0}}});
    builder.json["scenes"] = {{{"nodes", {0, 1, 2, 3, 4}}}, {{"nodes", {0, 1, 2, 3}}}};
    write(builder);
    (void)render("s.glb", {"--size", "64x64", "--scene", "1"});
    EXPECT_EQ(tilesSeen(), 4u);
}

} // namespace
} // namespace lavalight
