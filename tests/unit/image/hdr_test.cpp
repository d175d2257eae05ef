// Radiance files, as bytes written by hand: what they mean, and what is refused.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "image/hdr.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

const std::string kHead = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

std::string texel(int r, int g, int b, int e) {
    return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(e)};
}

class HdrTest : public testing::Test {
  protected:
    [[nodiscard]] Image read(const std::string& bytes) const {
        writeFileAtomically(folder_ / "map.hdr", bytes);
        return readHdr(folder_ / "map.hdr");
    }
    void expectRefusal(const std::string& bytes, const std::string& part) const {
        try {
            const Image image = read(bytes);
            ADD_FAILURE() << "was read: " << image.width << " x " << image.height;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("map.hdr"), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
    TemporaryFolder folder_;
};

TEST_F(HdrTest, MantissasOverTwoToTheEighthScaledByTheExponent) {
    const Image image =
        read(kHead + "\n-Y 1 +X 3\n" + texel(128, 64, 255, 129) + texel(9, 9, 9, 0) + texel(1, 2, 3, 136));
    EXPECT_EQ(image.at(0, 0), glm::vec3(1.0f, 0.5f, 255.0f / 128.0f));
    EXPECT_EQ(image.at(1, 0), glm::vec3(0.0f));
    EXPECT_EQ(image.at(2, 0), glm::vec3(1.0f, 2.0f, 3.0f));
}

TEST_F(HdrTest, ExposuresAreUndone) {
    const Image image = read(kHead + "EXPOSURE=2\nEXPOSURE= 4.0\n\n-Y 1 +X 1\n" + texel(16, 8, 0, 136));
    EXPECT_EQ(image.at(0, 0), glm::vec3(2.0f, 1.0f, 0.0f));
}

// C's atof, which Radiance reads them with, takes blanks and a sign.
TEST_F(HdrTest, ExposuresAreReadHoweverTheyAreWritten) {
    for (const char* line : {"EXPOSURE=+2.0e+00", "EXPOSURE=\t2", "EXPOSURE= \t +2. ", "EXPOSURE=2\r",
                             "EXPOSURE=2 1 1", "EXPOSURE=.5\nEXPOSURE=+4", "EXPOSURE=1e30\nEXPOSURE=2e-30"})
        EXPECT_NEAR(read(kHead + line + "\n\n-Y 1 +X 1\n" + texel(16, 8, 4, 136)).at(0, 0).x, 8.0f, 1e-6f)
            << line;
    for (const char* value : {"", "+", "two", "+-2", "2,5", "2x", "-2", "nan", "inf", "1e999", "1e-60"})
        expectRefusal(kHead + "EXPOSURE=" + value + "\n\n-Y 1 +X 1\n" + texel(1, 0, 0, 1), "exposure");
}

// Radiance's "filefmts": a multiplier as EXPOSURE is, for each of the primaries, and cumulative.
TEST_F(HdrTest, ColourCorrectionsAreUndone) {
    const std::string pixels = "\n\n-Y 1 +X 1\n" + texel(16, 8, 4, 136);
    EXPECT_EQ(read(kHead + "COLORCORR= 2 1 .5" + pixels).at(0, 0), glm::vec3(8, 8, 8));
    EXPECT_EQ(read(kHead + "COLORCORR=+2.0\t1 1\nEXPOSURE=4\nCOLORCORR=1 2e0 1" + pixels).at(0, 0),
              glm::vec3(2, 1, 1));
    for (const char* value : {"", "1", "1 2", "1 2 x", "1 0 1", "1 -1 1"})
        expectRefusal(fmt::format("{}COLORCORR={}{}", kHead, value, pixels), "colour correction");
    const std::string field = std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/colorcorr.hdr";
    const Image halved = readHdr(field); // its header says 2 1 1
    std::string bytes = readFile(field);
    bytes.replace(bytes.find("COLORCORR"), 4, "none");
    const Image stored = read(bytes);
    for (size_t i = 0; i < stored.pixels.size(); ++i)
        EXPECT_EQ(halved.pixels[i], stored.pixels[i] * glm::vec3(0.5f, 1.0f, 1.0f));
}

TEST_F(HdrTest, RowsFromTheBottomAreTurned) {
    const Image image = read(kHead + "\n+Y 2 +X 1\n" + texel(1, 0, 0, 136) + texel(2, 0, 0, 136));
    EXPECT_EQ(image.at(0, 0).x, 2.0f);
    EXPECT_EQ(image.at(0, 1).x, 1.0f);
}

TEST_F(HdrTest, NewRunsAndLiteralsOfEachComponent) {
    std::string row = {2, 2, 0, 8};
    row += std::string{static_cast<char>(128 + 8), 5};                   // red: eight times 5
    row += std::string{8, 1, 2, 3, 4, 5, 6, 7, 8};                       // green: literals
    row += std::string{static_cast<char>(128 + 3), 9, 5, 1, 1, 1, 1, 1}; // blue: both
    row += std::string{static_cast<char>(128 + 8), static_cast<char>(136)};
    const Image image = read(kHead + "\n-Y 1 +X 8\n" + row);
    EXPECT_EQ(image.at(0, 0), glm::vec3(5.0f, 1.0f, 9.0f));
    EXPECT_EQ(image.at(7, 0), glm::vec3(5.0f, 8.0f, 1.0f));
}

TEST_F(HdrTest, OldRunsRepeatTheLastPixel) {
    const Image image = read(kHead + "\n-Y 1 +X 300\n" + texel(3, 2, 1, 136) + texel(1, 1, 1, 42) +
                             texel(1, 1, 1, 1) + texel(9, 9, 9, 136));
    EXPECT_EQ(image.at(298, 0), glm::vec3(3.0f, 2.0f, 1.0f)); // 1 + 42 + 256 pixels
    EXPECT_EQ(image.at(299, 0), glm::vec3(9.0f));
}

TEST_F(HdrTest, WhatIsNoWholeMapIsRefused) {
    const std::string good = kHead + "\n-Y 2 +X 1\n" + texel(1, 0, 0, 136) + texel(2, 0, 0, 136);
    EXPECT_EQ(read(good).height, 2u);
    for (size_t length = 0; length < good.size(); ++length)
        EXPECT_THROW((void)read(good.substr(0, length)), Error) << length << " bytes";
    expectRefusal("\x89PNG\n", "not a Radiance HDR file");
    expectRefusal(kHead + "\n-Y 0 +X 4\n", "0 pixels");
    expectRefusal(kHead + "\n-Y 2000000000 +X 2000000000\n", "the limit is 16384");
    expectRefusal(kHead + "\n+X 1 -Y 1\n" + texel(1, 1, 1, 1), "left to right");
    expectRefusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + texel(1, 0, 0, 1), "RGBE");
    expectRefusal(kHead + "EXPOSURE=0\n\n-Y 1 +X 1\n" + texel(1, 0, 0, 1), "exposure");
    expectRefusal(kHead + "\n-Y 1 +X 2\n" + texel(1, 1, 1, 1) + texel(0, 0, 0, 1), "leaves its row");
    const std::string rest(8, '\1');
    expectRefusal(kHead + "\n-Y 1 +X 8\n" + std::string{2, 2, 0, 8, static_cast<char>(128 + 9), 1} + rest,
                  "leaves its row");
    expectRefusal(kHead + "\n-Y 1 +X 8\n" + std::string{2, 2, 0, 9, 8, 1} + rest, "claims 9 pixels of 8");
}

// The refusal comes before 1.6 GB are taken, and before 3.2 GB are decoded that no environment can use.
TEST_F(HdrTest, PixelsThatCannotBeInTheFileAndImagesBeyondTheLimitAreRefusedByTheHeader) {
    expectRefusal(kHead + "\n-Y 8192 +X 16384\n" + std::string(8192 * 12 - 1, '\1'),
                  "ends within its pixels");
    writeFileAtomically(folder_ / "map.hdr", kHead + "\n-Y 16384 +X 16384\n" + std::string(16384 * 12, '\1'));
    try {
        (void)readHdr(folder_ / "map.hdr", 1u << 27);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("it has 16384 x 16384 pixels; the limit is 134217728"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace lavalight::test
