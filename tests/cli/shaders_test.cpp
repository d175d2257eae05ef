// Shaders that a user changes: new-experiment, --shaders, --watch.
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "base/file.h"
#include "image/exr.h"
#include "support/run_program.h"
#include "support/running_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

class Shaders : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }
    [[nodiscard]] std::vector<std::string> renderInto(const std::string& file,
                                                      const std::vector<std::string>& more) const {
        std::vector<std::string> words{"render", "--size", "16x16", "--spp", "2", "-o", file};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    // In a copy of lib/sampling/roulette.glsl, `from` becomes `to`.
    void experiment(const std::string& from, const std::string& to) const {
        if (!std::filesystem::exists(folder_ / "mine")) {
            const ProgramResult made = run({"new-experiment", "mine", "lib/sampling/roulette.glsl"});
            ASSERT_EQ(made.exitCode, 0) << made.err;
        }
        std::string text = readFile(folder_ / "mine/lib/sampling/roulette.glsl");
        const size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        std::ofstream(folder_ / "mine/lib/sampling/roulette.glsl") << text.replace(at, from.size(), to);
    }
    [[nodiscard]] std::string header(const std::string& file, const std::string& key) const {
        const Metadata metadata = readExr(folder_ / file).metadata;
        const std::map<std::string, std::string> values(metadata.begin(), metadata.end());
        return values.contains(key) ? values.at(key) : "";
    }
    [[nodiscard]] std::vector<glm::vec3> pixels(const std::string& file) const {
        return readExr(folder_ / file).radiance().pixels;
    }

    const TemporaryFolder folder_;
};

const std::vector<std::string> kWithMine{"--shaders", "mine"};
constexpr const char* kCap = "kMaxSurvival = 0.95";

TEST_F(Shaders, AnExperimentChangesTheImageAndIsOnRecord) {
    ASSERT_EQ(run(renderInto("ours.exr", {})).exitCode, 0);
    experiment("// Russian", "// Russian");
    ASSERT_EQ(run(renderInto("copy.exr", kWithMine)).exitCode, 0);
    EXPECT_EQ(pixels("copy.exr"), pixels("ours.exr"));
    EXPECT_EQ(header("copy.exr", "option:shaders"), "");
    EXPECT_EQ(header("copy.exr", "bias-ledger"), header("ours.exr", "bias-ledger"));

    experiment(kCap, "kMaxSurvival = 0.2");
    ASSERT_EQ(run(renderInto("mine.exr", kWithMine)).exitCode, 0);
    EXPECT_NE(pixels("mine.exr"), pixels("ours.exr"));
    EXPECT_EQ(header("mine.exr", "option:shaders"), "lib/sampling/roulette.glsl");
    EXPECT_NE(header("mine.exr", "bias-ledger").find("changed-shaders"), std::string::npos);
}

TEST_F(Shaders, AnExperimentExplainsItselfAndIsNotOverwritten) {
    experiment(kCap, "kMaxSurvival = 0.2");
    EXPECT_NE(readFile(folder_ / "mine/README.md").find("--shaders mine"), std::string::npos);
    const ProgramResult again = run({"new-experiment", "mine", "lib/sampling/roulette.glsl"});
    EXPECT_EQ(again.exitCode, 1);
    EXPECT_NE(again.err.find("mine/lib/sampling/roulette.glsl"), std::string::npos) << again.err;
    EXPECT_NE(readFile(folder_ / "mine/lib/sampling/roulette.glsl").find("0.2"), std::string::npos);
    EXPECT_EQ(run({"new-experiment", "mine", "lib/sampling/mis.glsl"}).exitCode, 0);
    const ProgramResult unknown = run({"new-experiment", "mine", "lib/roulete.glsl"});
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_NE(unknown.err.find("lib/sampling/roulette.glsl"), std::string::npos) << unknown.err;
}

TEST_F(Shaders, WhatDoesNotCompileIsNamedAndLeavesNoImage) {
    experiment(kCap, "kMaxSurvival = ;");
    const ProgramResult result = run(renderInto("mine.exr", kWithMine));
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("mine/lib/sampling/roulette.glsl:6"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "mine.exr"));
    EXPECT_EQ(run(renderInto("mine.exr", {"--shaders", "nowhere"})).exitCode, 1);
    EXPECT_EQ(run(renderInto("mine.exr", {"--watch"})).exitCode, 2);
}

TEST_F(Shaders, EverySaveRendersAgainUnlessItIsBroken) {
    experiment("// Russian", "// Russian");
    RunningProgram program(renderInto("mine.exr", {"--shaders", "mine", "--watch"}), folder_.path());
    ASSERT_TRUE(program.waitForText("samples per pixel", 1)) << program.interrupt().err;
    const std::vector<glm::vec3> before = pixels("mine.exr");

    experiment(kCap, "kMaxSurvival = ;");
    ASSERT_TRUE(program.waitForText("mine/lib/sampling/roulette.glsl:6")) << program.interrupt().err;
    EXPECT_EQ(pixels("mine.exr"), before);

    experiment("kMaxSurvival = ;", "kMaxSurvival = 0.2");
    ASSERT_TRUE(program.waitForText("samples per pixel", 2)) << program.interrupt().err;
    const std::vector<glm::vec3> after = pixels("mine.exr");
    EXPECT_NE(after, before);

    experiment("kMaxSurvival = 0.2", kCap);
    ASSERT_TRUE(program.waitForText("samples per pixel", 3)) << program.interrupt().err;
    EXPECT_EQ(pixels("mine.exr"), before);

    const ProgramResult result = program.interrupt();
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_NE(result.err.find("changed: hosted/scatter, hosted/escape"), std::string::npos) << result.err;
}

// The host traces with code of its own, which does not know of the change.
TEST_F(Shaders, RaysThatAreTracedOtherwiseAreTracedByKernels) {
    const std::string path = "lib/math/ray_triangle.glsl";
    ASSERT_EQ(run({"new-experiment", "mine", path}).exitCode, 0);
    std::string text = readFile(folder_ / "mine" / path);
    const std::string condition = "determinant != 0.0 && hit.t > 0.0";
    ASSERT_NE(text.find(condition), std::string::npos);
    text.replace(text.find(condition), condition.size(), "determinant != 0.0 && hit.t > 1e30");
    std::ofstream(folder_ / "mine" / path) << text;
    const ProgramResult result = run(renderInto("mine.exr", {"--shaders", "mine"}));
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.err.find("the schedule is fused instead of hosted"), std::string::npos) << result.err;
    for (const glm::vec3& pixel : pixels("mine.exr"))
        ASSERT_EQ(pixel, glm::vec3(0.0f)) << "no triangle is met";
}

TEST_F(Shaders, ASavedToneCurveMakesThePictureAnew) {
    ASSERT_EQ(run({"new-experiment", "mine", "lib/film/tone_map.glsl"}).exitCode, 0);
    const std::string ours = readFile(folder_ / "mine/lib/film/tone_map.glsl");
    const auto save = [&](const std::string& more) {
        std::ofstream(folder_ / "mine/lib/film/tone_map.glsl") << ours + more;
    };
    RunningProgram program(renderInto("mine.exr", {"--png", "mine.png", "--shaders", "mine", "--watch"}),
                           folder_.path());
    ASSERT_TRUE(program.waitForText("samples per pixel", 1)) << program.interrupt().err;
    const std::string before = readFile(folder_ / "mine.png");
    save("this is no shader\n");
    ASSERT_TRUE(program.waitForText("mine/lib/film/tone_map.glsl:")) << program.interrupt().err;
    EXPECT_EQ(readFile(folder_ / "mine.png"), before);
    save("#define encodeSrgb(linear) (1.0 - encodeSrgb(linear))\n");
    ASSERT_TRUE(program.waitForText("samples per pixel", 2)) << program.interrupt().err;
    EXPECT_NE(readFile(folder_ / "mine.png"), before);
    EXPECT_NE(program.interrupt().err.find("changed: tonemap"), std::string::npos);
}

// The first image takes seconds; meanwhile there come a note, a broken shader, and a sound one.
TEST_F(Shaders, ARenderUnderWayIsEndedByOtherKernelsAlone) {
    experiment("// Russian", "// Russian");
    std::vector<std::string> words = renderInto("mine.exr", {"--shaders", "mine", "--watch", "--time", "4"});
    std::erase_if(words, [](const std::string& word) { return word == "--spp" || word == "2"; });
    RunningProgram program(words, folder_.path());
    program.waitUntilItCatchesInterrupts();
    std::ofstream(folder_ / "mine/notes.md") << "a note";
    ASSERT_TRUE(program.waitForText("no kernel has changed")) << program.interrupt().err;
    experiment(kCap, "kMaxSurvival = ;");
    ASSERT_TRUE(program.waitForText("mine/lib/sampling/roulette.glsl:6")) << program.interrupt().err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "mine.exr")) << "the machine is too slow for this test";
    ASSERT_TRUE(program.waitForText("samples per pixel", 1)) << "the render did not go on";
    EXPECT_EQ(header("mine.exr", "option:shaders"), "");

    experiment("kMaxSurvival = ;", "kMaxSurvival = 0.3");
    ASSERT_TRUE(program.waitForText("changed: hosted/scatter, hosted/escape")) << program.interrupt().err;
    experiment("kMaxSurvival = 0.3", "kMaxSurvival = 0.2");
    ASSERT_TRUE(program.waitForText("compiled in", 2)) << "the render with 0.3 did not end";
    ASSERT_TRUE(program.waitForText("samples per pixel", 2));
    const ProgramResult result = program.interrupt();
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_EQ(header("mine.exr", "option:shaders"), "lib/sampling/roulette.glsl");
}

} // namespace
} // namespace lavalight::test
