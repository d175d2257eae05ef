// `render --crop`: a part of an image has the bits of the whole, and parts are merged into it.
#include <algorithm>

#include <gtest/gtest.h>

#include "image/exr.h"
#include "support/run_program.h"
#include "support/same_image.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::expectSameImage;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

class Crop : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }
    [[nodiscard]] ProgramResult tryRender(const std::string& file,
                                          const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"render", "cornell-box", "--size", "32x24", "--quiet", "-o", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    void render(const std::string& file, const std::vector<std::string>& more) const {
        const ProgramResult result = tryRender(file, more);
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    void merge(const std::string& a, const std::string& b, const std::string& file) const {
        const ProgramResult result = run({"merge", a, b, "-o", file});
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    void expectUnmergeable(const std::string& a, const std::string& b, const std::string& part) const {
        const ProgramResult result = run({"merge", a, b, "-o", "out.exr"});
        EXPECT_EQ(result.exitCode, kFailed);
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }
    [[nodiscard]] std::filesystem::path at(const std::string& name) const { return folder_ / name; }

    const TemporaryFolder folder_;
};

class CropInSchedule : public Crop, public testing::WithParamInterface<const char*> {};

// A lens, layers and uneven windows, two of which meet at a corner alone.
TEST_P(CropInSchedule, PartsMergeIntoTheBitsOfTheWhole) {
    const auto options = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--schedule", GetParam(), "--aperture", "0.02", "--focus", "3", "--aov",
                                 "normal,depth,object-id"});
        return more;
    };
    render("whole.exr", options({"--samples", "0:3"}));
    render("a.exr", options({"--spp", "3", "--crop", "0,0,11x5"}));
    render("b.exr",
           options({"--spp", "3", "--crop", "11,5,21x19", "--wave-size", "100", "--band-rows", "4"}));
    render("c.exr", options({"--spp", "3", "--crop", "11,0,21x5"}));
    render("d.exr", options({"--samples", "0:3", "--crop", "0,5,11x19"}));
    merge("a.exr", "b.exr", "ab.exr");
    merge("c.exr", "d.exr", "cd.exr");
    EXPECT_EQ(valueOf(readFilmFile(at("ab.exr")).metadata, "samples-per-pixel"), "3");
    merge("ab.exr", "cd.exr", "abcd.exr");
    expectSameImage(at("abcd.exr"), at("whole.exr"));
    EXPECT_FALSE(readExr(at("abcd.exr")).place.has_value());
}
INSTANTIATE_TEST_SUITE_P(All, CropInSchedule, testing::Values("hosted", "wavefront", "fused"),
                         [](const auto& schedule) { return std::string(schedule.param); });

TEST_F(Crop, DataWindowLiesInTheWhole) {
    render("whole.exr", {"--spp", "2"});
    render("part.exr", {"--spp", "2", "--crop", "7,9,20x4", "--png", "part.png"});
    const ExrFile whole = readExr(at("whole.exr"));
    const ExrFile part = readExr(at("part.exr"));
    EXPECT_EQ(part.place, (ImagePlace{{7, 9}, {32, 24}}));
    ASSERT_EQ(part.radiance().width, 20u);
    ASSERT_EQ(part.radiance().height, 4u);
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 20; ++x)
            EXPECT_EQ(part.radiance().at(x, y), whole.radiance().at(x + 7, y + 9)) << x << ", " << y;
}

TEST_F(Crop, PartsOfAPartAreMergedToIt) {
    render("part.exr", {"--samples", "0:4", "--crop", "3,4,9x8"});
    render("a.exr", {"--samples", "0:1", "--crop", "3,4,9x8"});
    render("b.exr", {"--samples", "1:4", "--crop", "3,4,9x8"});
    merge("a.exr", "b.exr", "ab.exr");
    expectSameImage(at("ab.exr"), at("part.exr"));
}

TEST_F(Crop, PartsThatDoNotFitAreRefused) {
    render("a.exr", {"--samples", "0:2", "--crop", "0,0,8x8"});
    render("overlap.exr", {"--samples", "0:2", "--crop", "7,7,8x8"});
    expectUnmergeable("a.exr", "overlap.exr", "both hold its pixels 7,7,1x1");
    render("later.exr", {"--samples", "2:4", "--crop", "8,0,8x8"});
    expectUnmergeable("a.exr", "later.exr", "different samples (0:2 in a.exr, 2:4 in later.exr)");
    render("whole.exr", {"--samples", "2:4"});
    expectUnmergeable("a.exr", "whole.exr", "both hold its pixels 0,0,8x8");
}

TEST_F(Crop, ACheckpointIsOfItsPart) {
    render("a.exr", {"--spp", "4", "--crop", "3,4,9x8", "--checkpoint", "c.exr"});
    render("b.exr", {"--spp", "8", "--crop", "3,4,9x8", "--checkpoint", "c.exr", "--resume"});
    render("whole.exr", {"--samples", "0:8", "--crop", "3,4,9x8"});
    EXPECT_EQ(readFilmFile(at("b.exr")).film.words, readFilmFile(at("whole.exr")).film.words);
    const ProgramResult other =
        tryRender("d.exr", {"--spp", "16", "--crop", "4,4,9x8", "--checkpoint", "c.exr", "--resume"});
    EXPECT_EQ(other.exitCode, kFailed);
    EXPECT_NE(other.err.find("--crop (3,4,9x8 in the checkpoint, 4,4,9x8 in this render)"), std::string::npos)
        << other.err;
}

TEST_F(Crop, UsageThatCannotBeMeantIsRefused) {
    for (const char* crop : {"1", "0,0,0x4", "1,2,3,4", "-1,0,4x4", "0,0,4x4 4,0,4x4"}) {
        const ProgramResult result = tryRender("a.exr", {std::string("--crop=") + crop});
        EXPECT_EQ(result.exitCode, kWrongUsage) << crop;
        EXPECT_NE(result.err.find("--crop"), std::string::npos) << result.err;
    }
    const ProgramResult outside = tryRender("a.exr", {"--crop", "30,0,3x3"});
    EXPECT_EQ(outside.exitCode, kWrongUsage);
    EXPECT_NE(outside.err.find("30,0,3x3 leaves the image of 32x24 pixels"), std::string::npos)
        << outside.err;
}

} // namespace
} // namespace lavalight
