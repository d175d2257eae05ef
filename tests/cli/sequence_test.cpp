// `lavalight render --frames`: numbered files that hold what --at shows.
#include <cmath>
#include <string>

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

class Sequence : public testing::Test {
  protected:
    // A triangle that grows to thrice its size in one second, in front of a camera of its own or none.
    void SetUp() override {
        for (const bool hasCamera : {false, true}) {
            GltfBuilder builder;
            builder.addNode({{"mesh", builder.addTriangle()}});
            if (hasCamera) {
                builder.json["cameras"] = {
                    {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
                builder.addNode({{"camera", 0}, {"translation", {0, 0, 5}}});
            }
            const int keys = builder.addVec3({{1, 1, 1}, {3, 3, 3}});
            const int times = builder.addIndices<float>({0, 1}, test::kFloat);
            builder.json["animations"] = {
                {{"name", "grow"},
                 {"samplers", {{{"input", times}, {"output", keys}}}},
                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}};
            writeFileAtomically(folder_ / (hasCamera ? "seen.glb" : "unseen.glb"), builder.glb());
        }
    }

    [[nodiscard]] ProgramResult render(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"render", "--size", "16x12", "--spp", "2", "--quiet"});
        return runLavalight(arguments, folder_.path());
    }

    [[nodiscard]] std::vector<glm::vec3> pixels(const std::string& file) const {
        return readExr(folder_ / file).radiance().pixels;
    }

    const TemporaryFolder folder_;
};

TEST_F(Sequence, EachFrameIsTheImageOfItsTime) {
    const ProgramResult all = render({"seen.glb", "--frames", "1:4", "--fps", "4", "-o", "out.exr", "--png",
                                      "out.png", "--report", "out.json", "--tonemap", "agx"});
    ASSERT_EQ(all.exitCode, 0) << all.err;
    EXPECT_EQ(folder_.count(), 2 + 9);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out_0001.png"));
    ASSERT_EQ(render({"seen.glb", "--at", "0.75", "-o", "at.exr"}).exitCode, 0);
    EXPECT_EQ(pixels("out_0003.exr"), pixels("at.exr"));
    EXPECT_NE(pixels("out_0003.exr"), pixels("out_0001.exr"));
    const json report = json::parse(readFile(folder_ / "out_0003.json"));
    EXPECT_EQ(report.at("settings").at("at"), "0.75");
    EXPECT_EQ(report.at("png").at("tonemap"), "agx");
    EXPECT_EQ(report.at("seconds").at("prepareKernels"), 0.0); // the first frame's kernels serve
}

TEST_F(Sequence, CameraThatStandsInStaysWhereTheFirstFramePutsIt) {
    ASSERT_EQ(render({"unseen.glb", "--frames", "0:3", "--fps", "2", "-o", "out.exr"}).exitCode, 0);
    // From there the triangle grows; a camera that follows would see it as large as before.
    EXPECT_NE(pixels("out_0000.exr"), pixels("out_0002.exr"));
    ASSERT_EQ(render({"unseen.glb", "--at", "0", "-o", "first.exr"}).exitCode, 0);
    EXPECT_EQ(pixels("out_0000.exr"), pixels("first.exr"));
}

TEST_F(Sequence, RangesThatAreNoneAndTimesTwiceAreWrongUsage) {
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{"--frames", "3"},
                                               {"--frames", "3:3"},
                                               {"--frames", "a:b"},
                                               {"--frames", "0:2", "--fps", "0"},
                                               {"--frames", "0:2", "--at", "1"},
                                               {"--frames", "0:2", "--animation", "shrink"},
                                               {"--fps", "10"}}) {
        std::vector<std::string> arguments = wrong;
        arguments.insert(arguments.begin(), "seen.glb");
        const ProgramResult result = render(arguments);
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_NE(result.err.find("lavalight: error: "), std::string::npos);
    }
    EXPECT_EQ(folder_.count(), 2);
}

// Motion of a triangle that grows: from the middle of the view outwards, in pixels of the next frame.
TEST_F(Sequence, MotionLeadsToTheNextFrame) {
    const ProgramResult result =
        render({"seen.glb", "--frames", "0:2", "--fps", "2", "--aov", "motion,position", "-o", "out.exr"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const ExrFile first = readExr(folder_ / "out_0000.exr");
    const Layer* motion = first.find("motion");
    const Layer* position = first.find("position");
    ASSERT_NE(motion, nullptr);
    const double pixelsPerMetre = 6.0 / std::tan(0.5) / 5.0; // at the triangle, in the plane z = 0
    uint32_t met = 0;
    for (size_t i = 0; i < motion->mean.pixels.size(); ++i) {
        if (first.find("hits")->mean.pixels[i].x == 0.0f)
            continue;
        ++met; // half a second on, the triangle is twice as large
        EXPECT_NEAR(motion->mean.pixels[i].x, pixelsPerMetre * position->mean.pixels[i].x, 1e-3);
        EXPECT_NEAR(motion->mean.pixels[i].y, -pixelsPerMetre * position->mean.pixels[i].y, 1e-3);
    }
    EXPECT_GT(met, 2u);
    const ProgramResult alone = render({"seen.glb", "--aov", "motion", "-o", "one.exr"});
    EXPECT_EQ(alone.exitCode, 2);
    EXPECT_NE(alone.err.find("--frames"), std::string::npos) << alone.err;
}

} // namespace
} // namespace lavalight
