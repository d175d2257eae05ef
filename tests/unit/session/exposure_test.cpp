// The exposure that suits an image, and pictures that show nothing.
#include "session/exposure.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lavalight {
namespace {

Rendering imageOf(std::vector<glm::vec3> pixels) {
    Image image(static_cast<uint32_t>(pixels.size()), 1);
    image.pixels = std::move(pixels);
    return {std::move(image), std::nullopt, {}};
}

TEST(AutoExposure, MakesTheLogAverageLuminanceMiddleGrey) {
    EXPECT_NEAR(autoExposure(imageOf({glm::vec3(0.18f)})), 0.0f, 1e-6f);
    EXPECT_NEAR(autoExposure(imageOf({glm::vec3(0.045f), glm::vec3(2.88f)})), -1.0f, 1e-5f); // 2 down, 4 up
    EXPECT_NEAR(autoExposure(imageOf({{0.0f, 1.0f, 0.0f}})), std::log2(0.18 / 0.7152), 1e-5);
}

TEST(AutoExposure, LeavesOutBlackAndWhatIsNotCovered) {
    EXPECT_NEAR(autoExposure(imageOf({glm::vec3(0.36f), glm::vec3(0.0f)})), -1.0f, 1e-6f);
    EXPECT_EQ(autoExposure(imageOf({glm::vec3(0.0f)})), 0.0f);
    Rendering image = imageOf({glm::vec3(0.36f), glm::vec3(0.09f), glm::vec3(7.0f)});
    Image coverage(3, 1);
    coverage.pixels = {glm::vec3(1.0f), glm::vec3(0.25f),
                       glm::vec3(0.0f)}; // the second is 0.36, by a quarter
    image.layers.push_back({"coverage", {"A"}, coverage, std::nullopt});
    EXPECT_NEAR(autoExposure(image), -1.0f, 1e-6f);
}

TEST(AutoExposure, LeavesOutShadowsOnTheGround) {
    Rendering image = imageOf({glm::vec3(0.36f), glm::vec3(0.09f)});
    Image coverage(2, 1);
    coverage.pixels = {glm::vec3(1.0f), glm::vec3(0.75f)}; // the second is 0.36, by a quarter
    Image shadow(2, 1);
    shadow.pixels[1] = {0.75f, 3.0f, 1.0f};
    image.layers.push_back({"coverage", {"A"}, coverage, std::nullopt});
    image.layers.push_back({"shadow", {"shadow.N", "shadow.lit", "shadow.visible"}, shadow, std::nullopt});
    EXPECT_NEAR(autoExposure(image), -1.0f, 1e-6f);
}

TEST(Extremes, AreToldOfMoreThanHalfOfWhatIsShown) {
    constexpr uint32_t kWhite = 0xffffffff;
    constexpr uint32_t kBlack = 0xff000000;
    constexpr uint32_t kRed = 0xff0000ff;
    const auto text = [](const std::vector<uint32_t>& pixels) {
        return extremesText(pixels, nullptr, "this");
    };
    EXPECT_EQ(text({kWhite, kWhite, kRed}), "67 % of the picture is white; try this");
    EXPECT_EQ(text({kBlack, kBlack, kRed}), "67 % of the picture is black; try this");
    EXPECT_EQ(text({kWhite, kRed}), "");
    EXPECT_EQ(text({kWhite, kBlack, kRed}), "");
    EXPECT_EQ(text({}), "");
    Image coverage(4, 1); // the backdrop of three pixels is not the scene's
    coverage.pixels[3].x = 0.5f;
    EXPECT_EQ(extremesText(std::vector<uint32_t>{kWhite, kWhite, kWhite, kRed}, &coverage, ""), "");
    EXPECT_EQ(extremesText(std::vector<uint32_t>{kRed, kRed, kRed, kWhite}, &coverage, ""),
              "100 % of the picture is white");
}

} // namespace
} // namespace lavalight
