// Renders that are ended and go on: the bits of one that was not, or a line that says what is in the way.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/film_files.h"
#include "support/running_program.h"
#include "support/same_image.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using test::expectSameImage;
using test::ProgramResult;
using test::runLavalight;
using test::RunningProgram;
using test::TemporaryFolder;

class CheckpointTest : public testing::Test {
  protected:
    using Words = std::vector<std::string>;

    // A render of waves of a few milliseconds, that takes a second or two.
    [[nodiscard]] static Words render(const Words& more, const std::string& samples = "2:1500") {
        Words words{"render",      "--size", "64x48",         "--samples", samples,
                    "--wave-size", "16384",  "--max-bounces", "3"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    [[nodiscard]] ProgramResult run(const Words& words) const { return runLavalight(words, folder_.path()); }
    void expectSuccess(const Words& words) const {
        const ProgramResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.err;
    }
    [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }

    // Until the file is there, and newer than `time`.
    void waitForNew(const std::string& name, fs::file_time_type time, RunningProgram& program) const {
        std::error_code none;
        while (!fs::exists(at(name)) || fs::last_write_time(at(name), none) <= time) {
            ASSERT_FALSE(program.hasEnded()) << "it ended before it wrote " << name;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    const TemporaryFolder folder_;
};

TEST_F(CheckpointTest, KilledAtRandomMomentsAndResumedHasTheBitsOfOneThatWasNot) {
    expectSuccess(render({"-o", "whole.exr"}));
    const Words words =
        render({"-o", "a.exr", "--checkpoint", "c.exr", "--checkpoint-every", "0.02", "--resume"});
    std::mt19937 random(11);
    constexpr int kKills = 7;
    for (int i = 0; i < kKills; ++i) {
        const auto before =
            fs::exists(at("c.exr")) ? fs::last_write_time(at("c.exr")) : fs::file_time_type::min();
        RunningProgram program(words, folder_.path());
        if (i == 0) // before there is any checkpoint
            program.waitUntilItCatchesInterrupts();
        else
            waitForNew("c.exr", before, program);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 30000));
        EXPECT_EQ(program.kill().exitCode, 128 + SIGKILL);
        EXPECT_FALSE(fs::exists(at("a.exr")));
        if (i > 0) {
            EXPECT_FALSE(readFilmFile(at("c.exr")).isComplete()) << "the render is too short for the test";
        }
    }
    expectSuccess(words);
    expectSameImage(at("a.exr"), at("whole.exr"));
    EXPECT_TRUE(readFilmFile(at("c.exr")).isComplete());
    EXPECT_EQ(folder_.count(), 3) << "what killed renders were writing is still there";
}

TEST_F(CheckpointTest, InterruptedRenderLeavesOneToGoOnFrom) {
    const std::string samples = "2:400";
    expectSuccess(render({"-o", "whole.exr"}, samples));
    RunningProgram program(
        render({"-o", "a.exr", "--checkpoint", "c.exr", "--checkpoint-every", "1000"}, samples),
        folder_.path());
    const ProgramResult result = program.interrupt();
    EXPECT_EQ(result.exitCode, 130) << result.err;
    EXPECT_FALSE(readFilmFile(at("c.exr")).isComplete());
    // Neither the image so far nor the checkpoint can be merged; both can be continued.
    for (const char* name : {"a.exr", "c.exr"}) {
        const ProgramResult merged = run({"merge", name, "whole.exr", "-o", "m.exr"});
        EXPECT_EQ(merged.exitCode, 1);
        EXPECT_NE(merged.err.find("interrupted"), std::string::npos) << merged.err;
        expectSuccess(render({"-o", "b.exr", "--checkpoint", name, "--resume", "--band-rows", "5"}, samples));
        expectSameImage(at("b.exr"), at("whole.exr"));
    }
}

TEST_F(CheckpointTest, FinishedOneGivesTheImageAtOnce) {
    const Words words =
        render({"--checkpoint", "c.exr", "--checkpoint-every", "1000", "--resume", "-o", "a.exr"}, "0:4");
    const ProgramResult first = run(words);
    EXPECT_EQ(first.exitCode, 0);
    EXPECT_NE(first.err.find("there is no c.exr yet"), std::string::npos) << first.err;
    const std::string checkpoint = readFile(at("c.exr"));
    const std::string image = readFile(at("a.exr"));
    fs::remove(at("a.exr"));
    const ProgramResult second = run(words);
    EXPECT_EQ(second.exitCode, 0);
    EXPECT_EQ(second.err, "");
    EXPECT_EQ(readFile(at("c.exr")), checkpoint);
    expectSameImage(at("a.exr"), at("c.exr"));
    // It can be taken further.
    expectSuccess(render({"--checkpoint", "c.exr", "--resume", "-o", "b.exr"}, "0:9"));
    expectSuccess(render({"-o", "whole.exr"}, "0:9"));
    expectSameImage(at("b.exr"), at("whole.exr"));
}

TEST_F(CheckpointTest, OrdinaryRendersMayHaveOneToo) {
    const Words words{"render", "veach-mis", "--size", "16x12", "--spp", "2", "--quiet"};
    const auto with = [&](Words all, const Words& more) {
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    expectSuccess(with(words, {"-o", "a.exr", "--checkpoint", "c.exr"}));
    expectSuccess(with(words, {"-o", "b.exr", "--checkpoint", "c.exr", "--resume"}));
    EXPECT_EQ(readExr(at("a.exr")).radiance().pixels, readExr(at("b.exr")).radiance().pixels);
    EXPECT_NE(test::errorOf([&] { (void)readFilmFile(at("a.exr")); }), "") << "its image holds no film";
}

class CheckpointRefusal : public CheckpointTest {
  protected:
    void SetUp() override { expectSuccess(render({"--checkpoint", "c.exr", "-o", "a.exr"}, "0:4")); }

    void expectRefusal(const Words& words, int exitCode, const std::string& part) const {
        const std::string before = readFile(at("c.exr"));
        const long filesBefore = folder_.count();
        const ProgramResult result = run(words);
        EXPECT_EQ(result.exitCode, exitCode) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(folder_.count(), filesBefore) << "a file was left behind";
        EXPECT_EQ(readFile(at("c.exr")), before);
    }
    // Resuming with other options.
    void expectOther(const Words& more, const std::string& part, const std::string& samples = "0:4") const {
        Words words = render({"--checkpoint", "c.exr", "--resume", "-o", "b.exr"}, samples);
        words.insert(words.end(), more.begin(), more.end());
        expectRefusal(words, 1, part);
    }
};

TEST_F(CheckpointRefusal, OfAnotherRender) {
    expectOther({"--seed", "3"}, "--seed (0 in the checkpoint, 3 in this render)");
    expectOther({"--mis", "balance"}, "--mis (power in the checkpoint, balance in this render)");
    expectOther({"--schedule", "wavefront"}, "--schedule (hosted in the checkpoint");
    expectOther({"cornell-glass"}, "scene (cornell-box in the checkpoint, cornell-glass in this render)");
    expectOther({"--fov", "20"}, "--fov (none in the checkpoint, 20 in this render)");
    expectOther({}, "it is of samples 0:4, this render of 1:5", "1:5");
    expectOther({}, "it has 4 samples per pixel already, this render is of 3", "0:3");
}

// A comment changes no kernel.
TEST_F(CheckpointRefusal, OfOtherShaders) {
    const std::string text = readFile(fs::path(LAVALIGHT_SOURCE_DIR) / "shaders/lib/sampling/roulette.glsl");
    fs::create_directories(at("mine/lib/sampling"));
    writeFileAtomically(at("mine/lib/sampling/roulette.glsl"), text + "\n// A comment.\n");
    expectSuccess(render({"--checkpoint", "c.exr", "--resume", "-o", "b.exr", "--shaders", "mine"}, "0:4"));
    const std::string cap = "kMaxSurvival = 0.95";
    std::string other = text;
    writeFileAtomically(at("mine/lib/sampling/roulette.glsl"),
                        other.replace(text.find(cap), cap.size(), "kMaxSurvival = 0.9"));
    fs::remove(at("b.exr"));
    expectOther({"--shaders", "mine"}, "shaders (content ");
}

TEST_F(CheckpointRefusal, Damaged) {
    const std::string bytes = readFile(at("c.exr"));
    writeFileAtomically(at("c.exr"), bytes.substr(0, bytes.size() - 100));
    expectOther({}, "cannot read c.exr");
    std::string damaged = bytes;
    damaged[bytes.find("film:tallies") + 30] ^= 1;
    writeFileAtomically(at("c.exr"), damaged);
    expectOther({}, "c.exr");
    writeFileAtomically(at("c.exr"), "");
    expectOther({}, "cannot read c.exr");
}

TEST_F(CheckpointRefusal, ThereAlready) {
    expectRefusal(render({"--checkpoint", "c.exr", "-o", "b.exr"}), 1,
                  "c.exr is there already: go on from it with --resume, or remove it");
}

TEST_F(CheckpointRefusal, UsageThatCannotBeMeant) {
    constexpr int kWrongUsage = 2;
    expectRefusal({"render", "--resume"}, kWrongUsage, "--resume: needs --checkpoint");
    expectRefusal({"render", "--checkpoint-every", "3"}, kWrongUsage, "--checkpoint-every: needs");
    expectRefusal({"render", "--checkpoint", "d.exr", "--checkpoint-every", "-1"}, kWrongUsage,
                  "--checkpoint-every: -1 is outside");
    expectRefusal({"render", "--checkpoint", "d.exr", "--time", "1"}, kWrongUsage, "--checkpoint and --time");
    expectRefusal({"render", "--checkpoint", "d.exr", "--frames", "0:2"}, kWrongUsage,
                  "--checkpoint and --frames");
    expectRefusal({"render", "--checkpoint", "d.exr", "--watch"}, kWrongUsage, "--checkpoint and --watch");
    expectRefusal({"render", "--checkpoint", "d.exr", "-o", "d.exr"}, kWrongUsage, "cannot hold two outputs");
    expectRefusal({"render", "--checkpoint", "none/d.exr"}, 1, "none/d.exr");
}

} // namespace
} // namespace lavalight
