// `lavalight render --ground`: what is written of it, and what it does not mix with.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "image/exr.h"
#include "image/picture.h"
#include "support/film_files.h"
#include "support/run_program.h"
#include "support/same_image.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::expectSameImage;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

class GroundOption : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }
    // The scene "furnace" is a white ball under a white sky.
    void render(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"render",      "furnace", "--size",    "32x24", "--quiet",
                                           "--look-from", "0,4,8",   "--look-at", "0,0,0"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramResult result = run(arguments);
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    [[nodiscard]] std::filesystem::path at(const std::string& name) const { return folder_ / name; }

    const TemporaryFolder folder_;
};

TEST_F(GroundOption, ShadowIsInAlphaTheReportAndTheLedger) {
    render({"--ground", "shadow", "--background", "transparent", "--spp", "16", "-o", "a.exr", "--report",
            "a.json"});
    const ExrFile image = readExr(at("a.exr"));
    EXPECT_NE(valueOf(image.metadata, "bias-ledger").find("shadow-catcher"), std::string::npos);
    EXPECT_EQ(valueOf(image.metadata, "option:ground"), "shadow");
    size_t partly = 0;
    for (const glm::vec3& pixel : image.find("A")->mean.pixels)
        partly += pixel.x > 0.05f && pixel.x < 0.95f ? 1 : 0;
    EXPECT_GT(partly, 50u);
    const auto report = nlohmann::json::parse(readFile(at("a.json")));
    EXPECT_EQ(report.at("settings").at("ground"), "shadow");
    EXPECT_EQ(report.at("ledger").at(0).at("cause"), "shadow-catcher");
}

TEST_F(GroundOption, WhiteBackgroundArrivesAsWhiteAndShadowsAsGrey) {
    render({"--ground", "shadow", "--background", "#ffffff", "--spp", "16", "-o", "a.png"});
    const Picture png = decodePicture(readFile(at("a.png")));
    size_t white = 0;
    size_t grey = 0;
    for (size_t i = 0; i < png.bytes.size(); i += 4) {
        EXPECT_EQ(png.bytes[i + 3], 255);
        const bool isGrey = png.bytes[i] == png.bytes[i + 1] && png.bytes[i] == png.bytes[i + 2];
        white += isGrey && png.bytes[i] == 255 ? 1 : 0;
        grey += isGrey && png.bytes[i] < 240 ? 1 : 0;
    }
    EXPECT_GT(white, 100u);
    EXPECT_GT(grey, 20u);
}

TEST_F(GroundOption, PartsMergeToTheBitsOfTheWholeAndOtherGroundsAreRefused) {
    for (const std::vector<std::string>& background :
         {std::vector<std::string>{}, {"--background", "transparent"}}) {
        const auto part = [&](const std::string& samples, const std::string& file,
                              const std::string& ground) {
            std::vector<std::string> options{"--ground", ground, "--samples", samples, "-o", file};
            options.insert(options.end(), background.begin(), background.end());
            render(options);
        };
        part("0:8", "whole.exr", "shadow");
        part("0:3", "a.exr", "shadow");
        part("3:8", "b.exr", "shadow");
        ASSERT_EQ(run({"merge", "a.exr", "b.exr", "-o", "ab.exr"}).exitCode, 0);
        expectSameImage(at("ab.exr"), at("whole.exr"));
        part("3:8", "none.exr", "none");
        part("0:3", "grey.exr", "#808080");
        part("3:8", "green.exr", "#00ff00");
        for (const auto& [one, other] : {std::pair("a.exr", "none.exr"), std::pair("grey.exr", "green.exr"),
                                         std::pair("grey.exr", "b.exr")}) {
            const ProgramResult refused = run({"merge", one, other, "-o", "out.exr"});
            EXPECT_EQ(refused.exitCode, 1);
            EXPECT_NE(refused.err.find("--ground"), std::string::npos) << refused.err;
        }
    }
}

TEST_F(GroundOption, CheckpointsGoOn) {
    const std::vector<std::string> common{"--ground", "shadow", "--background", "transparent", "--spp", "8"};
    const auto with = [&](std::vector<std::string> options) {
        options.insert(options.begin(), common.begin(), common.end());
        return options;
    };
    render(with({"-o", "whole.exr", "--checkpoint", "whole.ckpt"}));
    std::vector<std::string> half = with({"-o", "half.exr", "--checkpoint", "half.ckpt"});
    half[5] = "4";
    render(half);
    render(with({"-o", "half.exr", "--checkpoint", "half.ckpt", "--resume"}));
    EXPECT_TRUE(readFilmFile(at("half.ckpt")).film.words == readFilmFile(at("whole.ckpt")).film.words);
}

TEST_F(GroundOption, OtherWordsAreRefused) {
    const ProgramResult result = run({"render", "furnace", "--ground", "lawn", "-o", "a.exr"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("--ground: cannot use \"lawn\""), std::string::npos) << result.err;
}

TEST_F(GroundOption, InfoAndViewsGoByTheModel) {
    render({"--ground", "#808080", "--spp", "1", "-o", "a.exr", "--report", "a.json"});
    render({"--spp", "1", "-o", "b.exr", "--report", "b.json"});
    const auto triangles = [&](const std::string& file) {
        return nlohmann::json::parse(readFile(at(file))).at("triangles").get<uint64_t>();
    };
    EXPECT_GT(triangles("a.json"), triangles("b.json"));
    for (const std::string ground : {"none", "#808080"})
        ASSERT_EQ(run({"render", "furnace", "--view", "front", "--ground", ground, "--size", "48x48", "--spp",
                       "1", "--background", "transparent", "--aov", "normal", "--quiet", "-o",
                       "view-" + ground.substr(0, 1) + ".exr"})
                      .exitCode,
                  0);
    // The ball, whose normals rise: what it covers is the same.
    const Image with = readExr(at("view-#.exr")).find("normal")->mean;
    const Image without = readExr(at("view-n.exr")).find("normal")->mean;
    EXPECT_EQ(with.at(24, 20), without.at(24, 20));
    EXPECT_EQ(with.at(20, 24), without.at(20, 24));
}

} // namespace
} // namespace lavalight
