// `lavalight compare` and the frame of the command line: exit codes, one-line messages, results on stdout.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "image/exr.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

Rendering grey(uint32_t side, float radiance, float variance) {
    Rendering rendering{Image(side, side), Image(side, side), std::vector<uint32_t>(size_t{side} * side, 4)};
    std::fill(rendering.radiance.pixels.begin(), rendering.radiance.pixels.end(), glm::vec3(radiance));
    std::fill(rendering.variance.pixels.begin(), rendering.variance.pixels.end(), glm::vec3(variance));
    return rendering;
}

// a.exr is grey at 1, b.exr 10 % brighter; both with a variance that explains a difference of one pixel.
class Compare : public testing::Test {
  protected:
    void SetUp() override {
        writeExr(folder_ / "a.exr", grey(32, 1.0f, 0.005f), {});
        writeExr(folder_ / "b.exr", grey(32, 1.1f, 0.005f), {});
        writeExr(folder_ / "small.exr", grey(16, 1.0f, 0.0f), {});
    }

    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }

    const TemporaryFolder folder_;
};

void expectOneErrorLine(const ProgramResult& result, int exitCode, const std::string& part) {
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("lavalight: error: ")) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.ends_with('\n')) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
}

TEST_F(Compare, AnImageEqualsItself) {
    const ProgramResult result = run({"compare", "a.exr", "a.exr", "--threshold", "0"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find("RMSE              0\n"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("relMSE            0\n"), std::string::npos) << result.out;
}

TEST_F(Compare, JsonHoldsTheFiguresOfTheDefinitions) {
    const ProgramResult result = run({"compare", "b.exr", "a.exr", "--json"});
    EXPECT_EQ(result.exitCode, 0) << result.err; // relMSE 0.0099 is just within the default of 0.01
    const json figures = json::parse(result.out);
    EXPECT_EQ(figures.at("width"), 32);
    EXPECT_NEAR(figures.at("rmse").get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(figures.at("relMse").get<double>(), 0.01 / 1.01, 1e-6);
    EXPECT_NEAR(figures.at("meanDifference").at("overall").get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(figures.at("meanDifference").at("perChannel").at(2).get<double>(), 0.1, 1e-6);
    EXPECT_EQ(figures.at("withinThreshold"), true);
    const json& zTest = figures.at("zTest");
    EXPECT_EQ(zTest.at("variancesOf"), "both");
    EXPECT_EQ(zTest.at("pixels").at("tests"), 3 * 32 * 32);
    EXPECT_EQ(zTest.at("tiles").at("tests"), 3 * 2 * 2);
    EXPECT_EQ(zTest.at("whole").at("tests"), 3);
    EXPECT_NEAR(zTest.at("pixels").at("maxAbsZ").get<double>(), 1.0, 1e-4); // 0.1 / sqrt(2 * 0.005)
    EXPECT_NEAR(zTest.at("tiles").at("maxAbsZ").get<double>(), 16.0, 1e-3);
    EXPECT_NEAR(zTest.at("whole").at("maxAbsZ").get<double>(), 32.0, 1e-3);
    EXPECT_EQ(zTest.at("pixels").at("fractionBelowLimit"), 1.0);
    EXPECT_EQ(zTest.at("tiles").at("fractionBelowLimit"), 0.0);
}

TEST_F(Compare, BeyondTheThresholdItPrintsTheFiguresAndExitsOne) {
    const ProgramResult result = run({"compare", "b.exr", "a.exr", "--threshold", "0.001", "--json"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(json::parse(result.out).at("withinThreshold"), false);
    EXPECT_NE(result.err.find("threshold 0.001"), std::string::npos) << result.err;
}

TEST_F(Compare, NanIsNeverWithinTheThreshold) {
    Rendering broken = grey(32, 1.0f, 0.005f);
    broken.radiance.pixels[5].y = std::numeric_limits<float>::quiet_NaN();
    writeExr(folder_ / "nan.exr", broken, {});
    const ProgramResult result = run({"compare", "nan.exr", "a.exr", "--threshold", "1e9", "--json"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(json::parse(result.out).at("nonFinitePixels").at("image"), 1);
    EXPECT_TRUE(json::parse(result.out).at("relMse").is_null());
}

TEST_F(Compare, FilesThatCannotBeComparedAreOneLineAndExitOne) {
    writeFileAtomically(folder_ / "text.exr", "no image");
    expectOneErrorLine(run({"compare", "a.exr", "none.exr"}), 1, "none.exr: no such file");
    expectOneErrorLine(run({"compare", "text.exr", "a.exr"}), 1, "text.exr");
    expectOneErrorLine(run({"compare", "a.exr", "."}), 1, "it is a directory");
    expectOneErrorLine(run({"compare", "a.exr", "small.exr"}), 1, "32 x 32 and 16 x 16");
    expectOneErrorLine(run({"compare", "a.exr", "line\nbreak.exr"}), 1, "line break.exr");
}

TEST_F(Compare, WrongUsageNamesTheFlagAndWhatItTakesAndExitsTwo) {
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold", "-1"}), 2, "--threshold: -1");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold", "few"}), 2, "at least 0");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold", "nan"}), 2, "at least 0");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold"}), 2, "--threshold");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--treshold", "1"}), 2, "--treshold");
    expectOneErrorLine(run({"compare", "a.exr"}), 2, "reference is required");
}

TEST_F(Compare, NothingIsEverWritten) {
    const long before = folder_.count();
    (void)run({"compare", "a.exr", "b.exr"});
    (void)run({"compare", "a.exr", "none.exr"});
    EXPECT_EQ(folder_.count(), before);
}

class CommandLine : public Compare {};

TEST_F(CommandLine, HelpAndVersionAreResults) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"compare", "--help"}, {"info", "--help"}, {"--version"}}) {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << arguments.front();
        EXPECT_EQ(result.err, "");
        EXPECT_NE(result.out, "");
    }
    EXPECT_TRUE(run({"--version"}).out.starts_with("lavalight 0.")) << run({"--version"}).out;
    EXPECT_NE(run({"compare", "--help"}).out.find("--threshold"), std::string::npos);
    EXPECT_NE(run({"compare", "--help"}).out.find("0.01"), std::string::npos); // the default
}

TEST_F(CommandLine, WithoutACommandTheHelpIsShownAndTheUsageWrong) {
    const ProgramResult result = run({});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("compare"), std::string::npos);
}

TEST_F(CommandLine, AnUnknownCommandIsAnsweredWithTheKnownOnes) {
    expectOneErrorLine(run({"rendr", "cornell-box"}), 2, "compare");
    expectOneErrorLine(run({"--threads", "2"}), 2, "--threads");
}

} // namespace
} // namespace lavalight
