// The range of lights (KHR_lights_punctual, "Range Property"): the recommended window, and nothing beyond.
#include <cmath>
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

constexpr double kPi = 3.14159265358979323846;

// A white Lambert wall in the plane z = 0, seen through a window so small that all of it is the origin.
GltfBuilder wall() {
    GltfBuilder builder;
    builder.addNode(
        {{"mesh", builder.addMesh(
                      {{"attributes", {{"POSITION", builder.addVec3({{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}})}}},
                       {"material", 0}})}});
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                                  {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}}};
    builder.json["cameras"] = {
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1e-3}, {"ymag", 1e-3}, {"znear", 0.01}, {"zfar", 100}}}}};
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 9}}});
    return builder;
}

void addLight(GltfBuilder& builder, json light, const std::vector<double>& place) {
    json& lights = builder.json["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(light));
    builder.addNode(
        {{"translation", place}, {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
}

class LightRange : public testing::Test {
  protected:
    // The mean radiance of the wall at the origin.
    [[nodiscard]] double radianceOf(const GltfBuilder& builder,
                                    const std::vector<std::string>& more = {"--spp", "16"}) const {
        writeFileAtomically(folder_ / "wall.glb", builder.glb());
        return radianceOf("wall.glb", "4x4", more);
    }
    [[nodiscard]] double radianceOf(const std::string& file, const std::string& size,
                                    const std::vector<std::string>& more = {"--spp", "16"}) const {
        std::vector<std::string> arguments{"render", file, "--size", size, "-o", "out.exr", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result = runLavalight(arguments, folder_.path());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        double sum = 0.0;
        const Image image = readExr(folder_ / "out.exr").radiance();
        for (const glm::vec3& pixel : image.pixels)
            sum += pixel.x;
        return sum / static_cast<double>(image.pixels.size());
    }

    const TemporaryFolder folder_;
};

// Irradiance of a wall across the light: intensity / distance^2 times the window; radiance is that by pi.
double expected(double intensity, double distance, double range) {
    const double window = std::max(0.0, 1.0 - std::pow(distance / range, 4.0));
    return intensity / (distance * distance) * window / kPi;
}

TEST_F(LightRange, WallTwoMetresFromALampOfRangeOneIsBlack) {
    const std::string field = std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/range1.glb";
    EXPECT_EQ(radianceOf(field, "16x16"), 0.0);
}

TEST_F(LightRange, WindowIsThatOfTheExtensionForPointsAndSpotsUnderEverySelection) {
    for (const char* type : {"point", "spot"})
        for (const double range : {1.0, 2.0, 2.5, 3.0, 1e4}) {
            GltfBuilder builder = wall();
            json light = {{"type", type}, {"intensity", 4.0 * kPi}, {"range", range}};
            if (light["type"] == "spot")
                light["spot"] = {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.6}};
            addLight(builder, light, {0, 0, 2});
            EXPECT_NEAR(radianceOf(builder), expected(4.0 * kPi, 2.0, range), 1e-5) << type << " " << range;
        }
    EXPECT_NEAR(expected(4.0 * kPi, 2.0, 3.0), 65.0 / 81.0, 1e-12); // 0.8025
}

TEST_F(LightRange, SumOfManyLampsIsThatOfTheirWindows) {
    GltfBuilder builder = wall();
    double sum = 0.0;
    for (int i = 0; i < 24; ++i) {
        const double height = 1.0 + 0.25 * i;
        const double range = 0.8 + 0.4 * (i * 7 % 24);
        addLight(builder, {{"type", "point"}, {"intensity", 1.0 + i % 3}, {"range", range}}, {0, 0, height});
        sum += expected(1.0 + i % 3, height, range);
    }
    for (const char* selection : {"power", "uniform", "tree"})
        for (const char* schedule : {"fused", "wavefront"})
            EXPECT_NEAR(radianceOf(builder,
                                   {"--light-selection", selection, "--schedule", schedule, "--spp", "1024"}),
                        sum, 0.02 * sum)
                << selection << " " << schedule;
}

TEST_F(LightRange, DirectionalLightsHaveNoneAndRangesThatAreNotAboveZeroAreNamed) {
    GltfBuilder sun = wall();
    addLight(sun, {{"type", "directional"}, {"intensity", kPi}, {"range", 0.001}}, {0, 0, 0});
    EXPECT_NEAR(radianceOf(sun), 1.0, 1e-5);
    for (const double range : {0.0, -3.0}) {
        GltfBuilder builder = wall();
        addLight(builder, {{"type", "point"}, {"intensity", 4.0 * kPi}, {"range", range}}, {0, 0, 2});
        EXPECT_NEAR(radianceOf(builder), 1.0, 1e-5);
        const ProgramResult info = runLavalight({"info", "wall.glb"}, folder_.path());
        EXPECT_NE(info.out.find("not above 0 were left out: light 0"), std::string::npos) << info.out;
    }
}

TEST_F(LightRange, InfoNamesIt) {
    GltfBuilder builder = wall();
    addLight(builder, {{"type", "point"}, {"range", 2.5}}, {0, 0, 2});
    addLight(builder, {{"type", "point"}}, {0, 0, 2});
    writeFileAtomically(folder_ / "wall.glb", builder.glb());
    const ProgramResult text = runLavalight({"info", "wall.glb"}, folder_.path());
    EXPECT_NE(text.out.find(", range 2.5 m\n"), std::string::npos) << text.out;
    const json lights =
        json::parse(runLavalight({"info", "wall.glb", "--json"}, folder_.path()).out).at("punctualLights");
    EXPECT_EQ(lights.at(0).at("range"), 2.5);
    EXPECT_FALSE(lights.at(1).contains("range"));
}

} // namespace
} // namespace lavalight
