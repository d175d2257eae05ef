// `lavalight split` and the scripts that it writes, run as a user would run them.
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/film_files.h"
#include "support/run_program.h"
#include "support/same_image.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

using test::ProgramResult;
using test::runLavalight;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

class Split : public testing::Test {
  protected:
    Split() { ::setenv("LAVALIGHT", LAVALIGHT_BINARY, 1); }

    void split(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "split");
        arguments.insert(arguments.end(), {"-o", "job"});
        const ProgramResult result = runLavalight(arguments, folder_.path());
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    // The exit code of a script of the job; what it says goes to log.txt.
    [[nodiscard]] int run(const std::string& script) const {
        const std::string command =
            "cd '" + folder_.path().string() + "' && job/" + script + " > log.txt 2>&1";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] std::string log() const { return readFile(folder_ / "log.txt"); }
    void render(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "render");
        arguments.insert(arguments.end(), {"--quiet"});
        const ProgramResult result = runLavalight(arguments, folder_.path());
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    // What an interrupted render of part 0, of four samples, leaves after two.
    void leaveCheckpoint() const {
        render({"cornell-box", "--size", "16x12", "--samples", "0:2", "-o", "two.exr"});
        FilmFile left = readFilmFile(folder_ / "two.exr");
        left.ranges = {{0, 4}};
        left.progress = {2, 0, 0};
        setValue(left.metadata, "option:spp", "4");
        writeFilmFile(folder_ / "job/parts/running/part-0000.elsewhere-1.checkpoint.exr", left);
    }
    void expectSameFilm(const std::string& a, const std::string& b) const {
        const FilmFile first = readFilmFile(folder_ / a);
        const FilmFile second = readFilmFile(folder_ / b);
        EXPECT_EQ(first.film.words, second.film.words) << a << ", " << b;
        EXPECT_EQ(textOf(first.ranges), textOf(second.ranges));
        EXPECT_EQ(valueOf(first.metadata, "bias-ledger"), valueOf(second.metadata, "bias-ledger"));
    }
    void expectRefusal(std::vector<std::string> arguments, int exitCode, const std::string& part) const {
        arguments.insert(arguments.begin(), "split");
        arguments.insert(arguments.end(), {"-o", "refused"});
        const ProgramResult result = runLavalight(arguments, folder_.path());
        EXPECT_EQ(result.exitCode, exitCode) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "refused")) << "a folder was left behind";
    }

    const test::TemporaryFolder folder_;
};

TEST_F(Split, MergedPartsHaveTheBitsOfOneRender) {
    split({"cornell-box", "--parts", "3", "--size", "32x24", "--spp", "10", "--schedule", "fused",
           "--look-from", "-0.1,1,3", "--look-at", "0,1,0", "--aov", "normal,object-id", "--png",
           "--exposure", "-1"});
    ASSERT_EQ(run("run.sh"), 0) << log();
    render({"cornell-box", "--size", "32x24", "--samples", "0:10", "--schedule", "fused", "--look-from",
            "-0.1,1,3", "--look-at", "0,1,0", "--aov", "normal,object-id", "--exposure", "-1", "-o",
            "whole.exr", "-o", "whole.png"});
    expectSameFilm("job/merged.exr", "whole.exr");
    EXPECT_EQ(readFile(folder_ / "job/merged.png"), readFile(folder_ / "whole.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "job/parts/running")) << "the merge cleans up";
}

TEST_F(Split, ColouredBackgroundsReachThePng) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "4", "--view", "front", "--background",
           "#204080", "--png"});
    ASSERT_EQ(run("run.sh"), 0) << log();
    render({"cornell-box", "--size", "16x12", "--samples", "0:4", "--view", "front", "--background",
            "#204080", "-o", "whole.exr", "-o", "whole.png"});
    expectSameFilm("job/merged.exr", "whole.exr");
    EXPECT_EQ(readFile(folder_ / "job/merged.png"), readFile(folder_ / "whole.png"));
}

TEST_F(Split, FramesOfATurntableAreJoinedOneByOne) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "4", "--turntable", "2", "--png"});
    ASSERT_EQ(run("run.sh"), 0) << log();
    render({"cornell-box", "--size", "16x12", "--samples", "0:4", "--turntable", "2", "-o", "whole.exr", "-o",
            "whole.png"});
    EXPECT_EQ(readFile(folder_ / "job/merged_0001.png"), readFile(folder_ / "whole_0001.png"));
    expectSameFilm("job/merged_0000.exr", "whole_0000.exr");
    expectSameFilm("job/merged_0001.exr", "whole_0001.exr");
}

TEST_F(Split, TheFolderHoldsAllThatItsPartsRead) {
    test::GltfBuilder builder;
    builder.addTriangle();
    builder.addNode({{"mesh", 0}});
    builder.json["buffers"] = {{{"byteLength", builder.bytes.size()}, {"uri", "triangle.bin"}}};
    writeFileAtomically(folder_ / "triangle.bin", builder.bytes);
    writeFileAtomically(folder_ / "triangle.gltf", builder.json.dump());
    render({"triangle.gltf", "--size", "16x12", "--samples", "0:4", "-o", "whole.exr"});
    split({"triangle.gltf", "--parts", "2", "--size", "16x12", "--spp", "4"});
    std::filesystem::remove(folder_ / "triangle.gltf");
    std::filesystem::remove(folder_ / "triangle.bin");
    std::filesystem::rename(folder_ / "job", folder_ / "moved");
    std::filesystem::create_directory_symlink("moved", folder_ / "job");
    ASSERT_EQ(run("run.sh"), 0) << log();
    expectSameFilm("moved/merged.exr", "whole.exr");
}

TEST_F(Split, APartThatIsDoneIsNotRenderedAgain) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "4"});
    ASSERT_EQ(run("part.sh 1"), 0) << log();
    const auto written = std::filesystem::last_write_time(folder_ / "job/parts/part-0001.exr");
    ASSERT_EQ(run("part.sh 1"), 0);
    EXPECT_EQ(log(), "parts/part-0001.exr is done\n");
    EXPECT_EQ(std::filesystem::last_write_time(folder_ / "job/parts/part-0001.exr"), written);
    for (const char* wrong : {"x", "08", "-1", "''"})
        EXPECT_EQ(run(std::string("part.sh ") + wrong), kWrongUsage) << wrong;
    EXPECT_EQ(run("part.sh 7"), kWrongUsage);
    EXPECT_NE(log().find("parts.txt has no such line"), std::string::npos) << log();
}

TEST_F(Split, AMissingPartFailsTheMergeByItsNameAndAPreviewGoesWithoutIt) {
    split({"cornell-box", "--parts", "3", "--size", "16x12", "--spp", "6"});
    ASSERT_EQ(run("part.sh 0"), 0) << log();
    ASSERT_EQ(run("part.sh 2"), 0) << log();
    EXPECT_EQ(run("merge.sh"), kFailed);
    EXPECT_NE(log().find("parts/part-0001.exr"), std::string::npos) << log();
    EXPECT_FALSE(std::filesystem::exists(folder_ / "job/merged.exr"));
    ASSERT_EQ(run("preview.sh"), 0) << log();
    EXPECT_EQ(textOf(readFilmFile(folder_ / "job/preview.exr").ranges), "0:2,4:6");
}

TEST_F(Split, APartGoesOnFromTheCheckpointThatAKilledProcessLeft) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "8", "--wave-size", "192"});
    render({"cornell-box", "--size", "16x12", "--samples", "0:8", "-o", "whole.exr"});
    leaveCheckpoint();
    ASSERT_EQ(run("part.sh 0"), 0) << log();
    EXPECT_EQ(log().find("starts from its first sample"), std::string::npos) << log();
    ASSERT_EQ(run("run.sh"), 0) << log();
    expectSameFilm("job/merged.exr", "whole.exr");
}

TEST_F(Split, APartStartsAfreshWhereTheCheckpointCannotBeUsed) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "8"});
    writeFileAtomically(folder_ / "job/parts/running/part-0000.elsewhere-1.checkpoint.exr",
                        std::string_view("damaged"));
    ASSERT_EQ(run("part.sh 0"), 0) << log();
    EXPECT_NE(log().find("part-0000 starts from its first sample"), std::string::npos) << log();
    EXPECT_TRUE(std::filesystem::exists(folder_ / "job/parts/part-0000.exr"));
}

TEST_F(Split, FilmsOfSeveralKindsOfMachineAreDevelopedAndNotWrittenAsOurs) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "4", "--png", "--statistical"});
    ASSERT_EQ(run("part.sh 0"), 0) << log();
    ASSERT_EQ(run("part.sh 1"), 0) << log();
    FilmFile other = readFilmFile(folder_ / "job/parts/part-0001.exr");
    setValue(other.metadata, "processor", "another");
    writeFilmFile(folder_ / "job/parts/part-0001.exr", other);
    ASSERT_EQ(run("merge.sh"), 0) << log();
    render({"cornell-box", "--size", "16x12", "--samples", "0:4", "-o", "whole.png"});
    EXPECT_EQ(readFile(folder_ / "job/merged.png"), readFile(folder_ / "whole.png"));
    const ProgramResult result =
        runLavalight({"render", "cornell-box", "--size", "16x12", "--spp", "4", "--checkpoint",
                      "job/merged.exr", "--resume", "-o", "again.exr"},
                     folder_.path());
    EXPECT_EQ(result.exitCode, kFailed) << "an EXR would say that this machine took all samples";
    EXPECT_NE(result.err.find("processor"), std::string::npos) << result.err;
}

TEST_F(Split, FoldersMayBeNamedWithASlashAndTheProgramByARelativePath) {
    std::filesystem::create_symlink(LAVALIGHT_BINARY, folder_ / "program");
    ::unsetenv("LAVALIGHT");
    const ProgramResult result = runLavalight({"split", "cornell-box", "--parts", "2", "--size", "16x12",
                                               "--spp", "2", "--program", "./program", "-o", "job/"},
                                              folder_.path());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(run("run.sh"), 0) << log();
}

TEST_F(Split, FlagsThatAreTurnedOffStayOff) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--panorama=false", "--validate=false"});
    const std::string part = readFile(folder_ / "job/part.sh");
    EXPECT_EQ(part.find("--panorama"), std::string::npos) << part;
    EXPECT_EQ(part.find("--validate"), std::string::npos) << part;
}

TEST_F(Split, ALateFailureKeepsTheCheckpointThatCameFar) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "8"});
    leaveCheckpoint();
    // A program that renders, and fails in the end.
    std::ofstream(folder_ / "failing") << "#!/bin/sh\n'" << LAVALIGHT_BINARY << "' \"$@\"\nexit 1\n";
    std::filesystem::permissions(folder_ / "failing", std::filesystem::perms::owner_all);
    ::setenv("LAVALIGHT", (folder_ / "failing").c_str(), 1);
    EXPECT_EQ(run("part.sh 0"), kFailed);
    EXPECT_EQ(log().find("starts from its first sample"), std::string::npos) << log();
}

TEST_F(Split, AnimationsByNameAreSplitByFrames) {
    test::GltfBuilder builder;
    const int node = builder.addNode({{"mesh", builder.addTriangle()}});
    const int times = builder.addAccessor({{"bufferView", builder.addView(std::vector<float>{0.0f, 1.0f})},
                                           {"componentType", 5126},
                                           {"count", 2},
                                           {"type", "SCALAR"},
                                           {"min", {0.0}},
                                           {"max", {1.0}}});
    const int places = builder.addVec3({{0, 0, 0}, {0, 1, 0}});
    builder.json["animations"] = {
        {{"name", "a rise"},
         {"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}}};
    writeFileAtomically(folder_ / "rise.glb", builder.glb());
    split({"rise.glb", "--parts", "2", "--size", "16x12", "--spp", "4", "--frames", "6:7", "--fps", "12",
           "--animation", "a rise"});
    ASSERT_EQ(run("run.sh"), 0) << log();
    render({"rise.glb", "--size", "16x12", "--samples", "0:4", "--frames", "6:7", "--fps", "12",
            "--animation", "a rise", "-o", "whole.exr"});
    expectSameFilm("job/merged_0006.exr", "whole_0006.exr");
}

TEST_F(Split, TheStatusCountsWhatIsThere) {
    split({"cornell-box", "--parts", "2", "--size", "16x12", "--spp", "8"});
    ASSERT_EQ(run("part.sh 0"), 0) << log();
    const ProgramResult result = runLavalight({"status", "job"}, folder_.path());
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.out.find("1 of 2 parts done, 0 running, 0 stopped, 1 missing"), std::string::npos)
        << result.out;
    EXPECT_EQ(runLavalight({"status", "nowhere"}, folder_.path()).exitCode, kFailed);
}

TEST_F(Split, WhatCannotBeSplitIsRefusedBeforeAnythingIsWritten) {
    expectRefusal({"cornell-box", "--parts", "65"}, kWrongUsage, "65 parts cannot share 64 samples");
    expectRefusal({"cornell-box", "--parts", "2", "--time", "5"}, kWrongUsage, "--time");
    expectRefusal({"cornell-box", "--parts", "2", "--denoise"}, kWrongUsage, "--png");
    expectRefusal({"cornell-box", "--parts", "2", "--constraint", "x"}, kWrongUsage, "--for slurm");
    expectRefusal({"cornell-box", "--parts", "2", "--camera-typo"}, kWrongUsage, "--camera-typo");
    expectRefusal({"cornell-box", "--parts", "2", "--fov", "500"}, kWrongUsage, "--fov");
    expectRefusal({"cornell-box", "--parts", "2", "--frame", "3"}, kWrongUsage, "--frames A:B");
    expectRefusal({"cornell-box", "--parts", "2", "--aov", "motion"}, kWrongUsage, "--frames or --turntable");
    expectRefusal({"cornell-box", "--parts", "2", "--schedule", "fused", "--accelerator", "embree"},
                  kWrongUsage, "try --schedule hosted");
    expectRefusal({"cornell-box", "--parts", "2", "--camera", ""}, kWrongUsage, "its value is empty");
    expectRefusal({"cornell-box", "--parts", "20000", "--spp", "20000"}, kWrongUsage, "more than 10000");
    expectRefusal({"cornell-box", "--parts", "2", "--shaders", "."}, kFailed, "the job's folder is in it");
    expectRefusal({"missing.gltf", "--parts", "2"}, kFailed, "missing.gltf");
    std::filesystem::create_directory(folder_ / "full");
    writeFileAtomically(folder_ / "full/file", std::string_view("x"));
    const ProgramResult result =
        runLavalight({"split", "cornell-box", "--parts", "2", "-o", "full"}, folder_.path());
    EXPECT_EQ(result.exitCode, kFailed);
    EXPECT_NE(result.err.find("it is not an empty folder"), std::string::npos) << result.err;
}

} // namespace
} // namespace lavalight
