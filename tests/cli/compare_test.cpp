// `lavalight compare` and the frame of the command line: exit codes, one-line messages, results on stdout.
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "compare/heat_colours.h"
#include "image/exr.h"
#include "image/picture.h"
#include "image/png.h"
#include "support/full_disk.h"
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
    std::fill(rendering.radiance().pixels.begin(), rendering.radiance().pixels.end(), glm::vec3(radiance));
    std::fill(rendering.variance().pixels.begin(), rendering.variance().pixels.end(), glm::vec3(variance));
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

const json& criterion(const json& figures, const std::string& name) {
    const json& all = figures.at("criteria");
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const json& c) { return c.at("criterion") == name; });
    if (found == all.end())
        throw std::runtime_error("no criterion " + name);
    return *found;
}

TEST_F(Compare, AnImageEqualsItself) {
    for (const std::vector<std::string>& criteria :
         {std::vector<std::string>{}, {"--threshold", "0"}, {"--flip-threshold", "0"}, {"--z-test"}}) {
        std::vector<std::string> arguments{"compare", "a.exr", "a.exr"};
        arguments.insert(arguments.end(), criteria.begin(), criteria.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_EQ(result.err, "");
        EXPECT_NE(result.out.find("RMSE              0\n"), std::string::npos) << result.out;
        EXPECT_NE(result.out.find("relMSE            0\n"), std::string::npos) << result.out;
        EXPECT_NE(result.out.find("EQUAL"), std::string::npos) << result.out;
    }
}

TEST_F(Compare, JsonHoldsTheFiguresOfTheDefinitions) {
    const ProgramResult result = run({"compare", "b.exr", "a.exr", "--threshold", "0.01", "--json"});
    EXPECT_EQ(result.exitCode, 0) << result.err; // relMSE is 0.0099
    const json figures = json::parse(result.out);
    EXPECT_EQ(figures.at("width"), 32);
    EXPECT_NEAR(figures.at("rmse").get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(figures.at("relMse").get<double>(), 0.01 / 1.01, 1e-6);
    EXPECT_NEAR(figures.at("meanDifference").at("overall").get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(figures.at("meanDifference").at("perChannel").at(2).get<double>(), 0.1, 1e-6);
    EXPECT_EQ(figures.at("equal"), true);
    EXPECT_EQ(criterion(figures, "relMSE").at("passed"), true);
    EXPECT_EQ(figures.at("flip").at("range"), "HDR");
    EXPECT_GT(figures.at("flip").at("mean").get<double>(), 0.01);
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
    EXPECT_EQ(zTest.at("pixels").at("p"), 1.0);
    EXPECT_LT(zTest.at("p").get<double>(), 1e-20);
}

TEST_F(Compare, BeyondALimitItPrintsTheFiguresNamesTheCriterionAndExitsOne) {
    const ProgramResult result = run({"compare", "b.exr", "a.exr", "--threshold", "0.001", "--flip-threshold",
                                      "0.9", "--z-test", "--json"});
    EXPECT_EQ(result.exitCode, 1);
    const json figures = json::parse(result.out);
    EXPECT_EQ(figures.at("equal"), false);
    EXPECT_EQ(criterion(figures, "relMSE").at("passed"), false);
    EXPECT_EQ(criterion(figures, "Z-test").at("passed"), false);
    EXPECT_EQ(criterion(figures, "FLIP").at("passed"), true);
    EXPECT_NE(result.err.find("relMSE 0.00990"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("limit is 0.001"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("whole image in R: |z| 32"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("FLIP"), std::string::npos) << result.err;
}

TEST_F(Compare, WithoutCriteriaVariancesDecideAndWithoutThemRelMse) {
    EXPECT_EQ(run({"compare", "b.exr", "a.exr"}).exitCode, 1); // by the Z-test
    Rendering noisy = grey(32, 1.1f, 10.0f);
    writeExr(folder_ / "noisy.exr", noisy, {});
    EXPECT_EQ(run({"compare", "noisy.exr", "a.exr"}).exitCode, 0);
    const std::vector<uint32_t> dark(16 * 16, 0xff404040);
    const std::vector<uint32_t> light(16 * 16, 0xff606060);
    writePng(folder_ / "dark.png", 16, 16, dark);
    writePng(folder_ / "light.png", 16, 16, light);
    const ProgramResult result = run({"compare", "light.png", "dark.png", "--json"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(criterion(json::parse(result.out), "relMSE").at("limit"), 0.01);
}

TEST_F(Compare, PngFilesAreComparedInLinearValuesAndByLdrFlip) {
    const std::vector<uint32_t> pixels(16 * 16, 0xff808080); // linear 0.2159
    const std::vector<uint32_t> black(16 * 16, 0xff000000);
    writePng(folder_ / "grey.png", 16, 16, pixels);
    writePng(folder_ / "black.png", 16, 16, black);
    const json figures =
        json::parse(run({"compare", "grey.png", "black.png", "--json", "--threshold", "inf"}).out);
    EXPECT_NEAR(figures.at("rmse").get<double>(), 0.2159, 1e-4);
    EXPECT_EQ(figures.at("flip").at("range"), "LDR");
    EXPECT_TRUE(figures.at("zTest").is_null());
}

TEST_F(Compare, ASignificanceIsHowOftenEqualRendersMayFail) {
    Rendering shifted = grey(32, 1.0f, 0.005f);
    for (glm::vec3& p : shifted.radiance().pixels)
        p += 0.0125f; // 4 standard deviations of the whole image, 2 of a tile: p = 3 * 3 * 6.3e-5
    writeExr(folder_ / "shifted.exr", shifted, {});
    EXPECT_EQ(run({"compare", "shifted.exr", "a.exr"}).exitCode, 0);
    EXPECT_EQ(run({"compare", "shifted.exr", "a.exr", "--significance", "0.01"}).exitCode, 1);
    EXPECT_EQ(run({"compare", "shifted.exr", "a.exr", "--significance", "0.0001"}).exitCode, 0);
}

TEST_F(Compare, NanIsAlwaysADifference) {
    Rendering broken = grey(32, 1.0f, 0.005f);
    broken.radiance().pixels[5].y = std::numeric_limits<float>::quiet_NaN();
    writeExr(folder_ / "nan.exr", broken, {});
    const ProgramResult result = run({"compare", "nan.exr", "a.exr", "--flip-threshold", "1", "--json"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(json::parse(result.out).at("nonFinitePixels"), 1);
    EXPECT_TRUE(json::parse(result.out).at("relMse").is_null());
    EXPECT_NE(result.err.find("pixel 5, 0"), std::string::npos) << result.err;
    EXPECT_EQ(run({"compare", "nan.exr", "a.exr", "--threshold", "1e9"}).exitCode, 1);
    expectOneErrorLine(run({"compare", "a.exr", "nan.exr"}), 3, "nan.exr has 1 pixels");
}

TEST_F(Compare, WhatCannotBeComparedIsOneLineAndExitsThree) {
    writeFileAtomically(folder_ / "text.exr", "no image");
    writeFileAtomically(folder_ / "damaged.png", "\x89PNG and no more");
    writePng(folder_ / "small.png", 16, 16, std::vector<uint32_t>(16 * 16));
    expectOneErrorLine(run({"compare", "a.exr", "none.exr"}), 3, "none.exr: no such file");
    expectOneErrorLine(run({"compare", "text.exr", "a.exr"}), 3, "text.exr");
    expectOneErrorLine(run({"compare", "damaged.png", "small.png"}), 3, "damaged.png");
    expectOneErrorLine(run({"compare", "a.exr", "."}), 3, "it is a directory");
    expectOneErrorLine(run({"compare", "a.exr", "small.exr"}), 3, "32 x 32 and 16 x 16");
    expectOneErrorLine(run({"compare", "small.exr", "small.png"}), 3, "one holds radiance");
    expectOneErrorLine(run({"compare", "small.png", "small.png", "--z-test"}), 3,
                       "neither image has variances");
    expectOneErrorLine(run({"compare", "a.exr", "line\nbreak.exr"}), 3, "line break.exr");
    expectOneErrorLine(run({"compare", "a.exr", "a.exr", "--html", "none/report.html"}), 3,
                       "none/report.html");
    expectOneErrorLine(run({"compare", "a.exr", "a.exr", "--heatmap", "none/map.png"}), 3, "none/map.png");
}

TEST_F(Compare, WrongUsageNamesTheFlagAndWhatItTakesAndExitsTwo) {
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold", "-1"}), 2, "--threshold: -1");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold", "few"}), 2, "at least 0");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold", "nan"}), 2, "at least 0");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--flip-threshold", "-1"}), 2, "at least 0");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--significance", "0"}), 2, "between 0 and 1");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--significance", "1"}), 2, "between 0 and 1");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--threshold"}), 2, "--threshold");
    expectOneErrorLine(run({"compare", "a.exr", "b.exr", "--treshold", "1"}), 2, "--treshold");
    expectOneErrorLine(run({"compare", "a.exr"}), 2, "reference is required");
}

TEST_F(Compare, NothingIsWrittenUnasked) {
    const long before = folder_.count();
    (void)run({"compare", "a.exr", "b.exr"});
    (void)run({"compare", "a.exr", "none.exr"});
    EXPECT_EQ(folder_.count(), before);
}

TEST_F(Compare, TheHeatmapIsAPictureOfFlip) {
    EXPECT_EQ(run({"compare", "b.exr", "a.exr", "--heatmap", "map.png"}).exitCode, 1);
    const Picture map = decodePicture(readFile(folder_ / "map.png"));
    ASSERT_EQ(map.width, 32u);
    ASSERT_EQ(map.height, 32u);
    const json figures = json::parse(run({"compare", "b.exr", "a.exr", "--json"}).out);
    const uint32_t colour = heatColour(figures.at("flip").at("mean").get<float>()); // all pixels have it
    EXPECT_EQ(map.bytes[0], colour & 255);
    EXPECT_EQ(map.bytes[1], colour >> 8 & 255);
    EXPECT_EQ(map.bytes[2], colour >> 16 & 255);
}

TEST_F(Compare, TheReportIsOneFileThatHoldsImagesAndVerdicts) {
    writeExr(folder_ / "c.exr", grey(32, 1.1f, 0.005f), {{"scene", "</script><b>"}, {"device", "\xff"}});
    EXPECT_EQ(run({"compare", "c.exr", "a.exr", "--html", "report.html"}).exitCode, 1);
    const std::string page = readFile(folder_ / "report.html");
    const size_t begin = page.find("const data = ") + 13;
    const json data = json::parse(page.substr(begin, page.find(";\n", begin) - begin));
    EXPECT_EQ(data.at("figures").at("equal"), false);
    EXPECT_EQ(data.at("exposures").size(), 3u);
    EXPECT_TRUE(
        data.at("exposures")[1].at("image").get<std::string>().starts_with("data:image/png;base64,iVBOR"));
    EXPECT_TRUE(data.at("heatmap").get<std::string>().starts_with("data:image/png;base64,iVBOR"));
    EXPECT_TRUE(data.at("scale").get<std::string>().starts_with("data:image/png;base64,iVBOR"));
    EXPECT_EQ(data.at("metadata")[1].at("image"), "</script><b>");
    EXPECT_EQ(page.find("</script><b>"), std::string::npos);
    for (const char* elsewhere : {"http:", "https:", "@import", "<link", "<script src"})
        EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
}

TEST_F(Compare, AFullDiskIsNoDifference) {
    const test::FullDisk disk(0);
    EXPECT_EQ(run({"compare", "a.exr", "a.exr", "--heatmap", "map.png"}).exitCode, 3);
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
