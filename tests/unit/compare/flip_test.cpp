// FLIP equals the authors' own program, whose values are in tests/references/flip.
#include "compare/flip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/picture.h"
#include "image/srgb.h"

namespace lavalight {
namespace {

const std::string kFolder = std::string(LAVALIGHT_SOURCE_DIR) + "/tests/references/flip/";

Image readPng(const std::string& path) {
    const Picture picture = decodePicture(readFile(path));
    Image image(picture.width, picture.height);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            image.pixels[i][c] =
                static_cast<float>(decodeSrgb(picture.bytes[4 * i + static_cast<size_t>(c)] / 255.0));
    return image;
}

class FlipReference : public testing::TestWithParam<const char*> {};

TEST_P(FlipReference, EachPixelAndTheMeanAreThoseOfTheAuthorsProgram) {
    const std::string name = GetParam();
    const auto value = nlohmann::json::parse(readFile(kFolder + "values.json")).at(name);
    const bool isHdr = value.at("range") == "HDR";
    const std::string path = kFolder + name;
    const FlipMap map = isHdr ? flipOfRadiance(readExr(path + "-image.exr").radiance(),
                                               readExr(path + "-reference.exr").radiance())
                              : flip(readPng(path + "-image.png"), readPng(path + "-reference.png"));
    EXPECT_NEAR(map.mean() / value.at("mean").get<double>(), 1.0, 1e-3); // 1e-5 was measured
    const Image expected = readExr(path + "-flip.exr").radiance();
    ASSERT_EQ(map.errors.size(), expected.pixels.size());
    for (size_t i = 0; i < map.errors.size(); ++i) // stored as half floats, 5e-4 apart at 1
        ASSERT_NEAR(map.errors[i], expected.pixels[i].r, 2e-3)
            << "pixel " << i % map.width << ", " << i / map.width;
}

INSTANTIATE_TEST_SUITE_P(Pairs, FlipReference,
                         testing::Values("chart", "noise", "noise-radiance", "tint-radiance"),
                         [](const auto& pair) {
                             std::string name = pair.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(FlipOfRadiance, ShowsTheExposuresOfTheAuthorsProgram) {
    const auto values = nlohmann::json::parse(readFile(kFolder + "values.json"));
    for (const std::string name : {"noise-radiance", "tint-radiance"}) {
        const ExposureRange range = exposureRange(readExr(kFolder + name + "-reference.exr").radiance());
        EXPECT_NEAR(range.start, values.at(name).at("startExposure").get<float>(), 1e-3f);
        EXPECT_NEAR(range.stop, values.at(name).at("stopExposure").get<float>(), 1e-3f);
        EXPECT_EQ(range.count, values.at(name).at("exposures").get<uint32_t>());
    }
}

Image constant(uint32_t width, uint32_t height, glm::vec3 value) {
    Image image(width, height);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

TEST(Flip, OfEqualImagesIsZeroAndOfGreenAndBlueOne) {
    const Image green = constant(9, 200, {0.0f, 1.0f, 0.0f}); // several strips
    EXPECT_EQ(flip(green, green).mean(), 0.0);
    EXPECT_NEAR(flip(green, constant(9, 200, {0.0f, 0.0f, 1.0f})).mean(), 1.0, 1e-4);
}

TEST(Flip, DoesNotSeeWhereItsStripsMeet) {
    Image dots = constant(40, 200, glm::vec3(0.5f));
    for (uint32_t y = 3; y < dots.height; y += 32)
        dots.pixels[size_t{y} * dots.width + 20] = glm::vec3(1.0f);
    const FlipMap map = flip(dots, constant(40, 200, glm::vec3(0.5f)));
    for (uint32_t y = 32; y + 64 < dots.height; ++y) // the picture repeats every 32 rows, strips have 64
        for (uint32_t x = 0; x < dots.width; ++x)
            ASSERT_NEAR(map.errors[size_t{y} * 40 + x], map.errors[size_t{y + 32} * 40 + x], 1e-6f)
                << x << ", " << y;
}

TEST(Flip, OfNanNegativeAndInfiniteValuesIsANumber) {
    Image image = constant(8, 8, glm::vec3(0.2f));
    image.pixels[9] = {std::nanf(""), -1.0f, std::numeric_limits<float>::infinity()};
    const Image reference = constant(8, 8, glm::vec3(0.2f));
    const FlipMap map = flipOfRadiance(image, reference);
    EXPECT_TRUE(
        std::all_of(map.errors.begin(), map.errors.end(), [](float e) { return e >= 0.0f && e <= 1.0f; }));
    EXPECT_GT(map.errors[9], 0.3f);
}

TEST(Flip, OfBlackImagesIsZero) {
    const Image black = constant(5, 4, glm::vec3(0.0f));
    EXPECT_EQ(flipOfRadiance(black, black).mean(), 0.0);
    EXPECT_EQ(exposureRange(black).count, 2u);
}

// Exposures and mean by the authors' program, as in tests/references/make_flip_references.py.
TEST(FlipOfRadiance, OfALitSpotInTheDarkIsThatOfTheAuthorsProgram) {
    Image reference = constant(32, 32, glm::vec3(0.0f));
    Image image = reference;
    for (uint32_t y = 8; y < 12; ++y)
        for (uint32_t x = 8; x < 12; ++x) {
            reference.pixels[size_t{y} * 32 + x] = glm::vec3(5.0f);
            image.pixels[size_t{y} * 32 + x] = glm::vec3(y < 10 ? 6.0f : 5.0f);
        }
    const ExposureRange range = exposureRange(reference);
    EXPECT_NEAR(range.start, -1.23863f, 1e-4f);
    EXPECT_NEAR(range.stop, 24.0833f, 1e-4f);
    EXPECT_EQ(range.count, 26u);
    EXPECT_NEAR(flipOfRadiance(image, reference).mean(), 0.00211462, 1e-6);
}

TEST(Flip, SizesMustAgree) {
    EXPECT_THROW((void)flip(Image(2, 2), Image(2, 3)), Error);
    EXPECT_THROW((void)flipOfRadiance(Image(), Image()), Error);
}

} // namespace
} // namespace lavalight
