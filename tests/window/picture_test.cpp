// The pictures that the window shows of an image: layers, denoised, before a background, exposed.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "denoise/denoiser.h"
#include "film/film_layout.h"
#include "image/exr.h"
#include "image/picture.h"
#include "view/layer_display.h"
#include "view/shown_layer.h"
#include "window/view_window.h"

namespace lavalight::test {
namespace {

using Pictures = ViewWindow;

Screenshot screenshotOf(const std::vector<uint32_t>& pixels, uint32_t width) {
    Screenshot shot{width, static_cast<uint32_t>(pixels.size() / width), {}};
    for (const uint32_t pixel : pixels)
        shot.pixels.emplace_back(pixel & 255u, pixel >> 8u & 255u, pixel >> 16u & 255u);
    return shot;
}

TEST_F(Pictures, LayersAreThoseOfRenderOneAfterAnother) {
    open({"cornell-box"});
    std::vector<uint32_t> rows;
    std::string names;
    for (const ShownLayer& shown : shownLayers())
        if (shown.row != kColorPlane) {
            rows.push_back(shown.row);
            names += (names.empty() ? "" : ",") + nameOf(shown);
        }
    const ProgramResult result = runLavalight(
        with({"render", "cornell-box", "--aov", names, "-o", "layers.exr"}, with(kSamples, kSmall)),
        folder_.path());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const ExrFile layers = readExr(folder_ / "layers.exr");
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        SCOPED_TRACE(planeName(*row));
        key("shift+v");
        expectShown(screenshotOf(displayOf(layers, *row, 1.0f), 240));
    }
    key("ctrl+s");
    ASSERT_TRUE(program_->waitForText("saved cornell-box-1.exr"));
    const ExrFile saved = readExr(folder_ / "cornell-box-1.exr");
    for (const uint32_t row : rows) {
        ASSERT_NE(saved.find(planeName(row)), nullptr) << planeName(row);
        EXPECT_EQ(saved.find(planeName(row))->mean.pixels, layers.find(planeName(row))->mean.pixels);
    }
    EXPECT_EQ(saved.find("guide-albedo"), nullptr);
    quit();
}

TEST_F(Pictures, ColourComesBackWithoutARestart) {
    open({"cornell-box"});
    const Screenshot color = rendered({"cornell-box"});
    expectShown(color);
    key("shift+v");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    waitFor(kDone);
    key("v");
    expectShown(color);
    quit();
}

class PicturesWith : public ViewWindow, public testing::WithParamInterface<std::vector<std::string>> {};

TEST_P(PicturesWith, AreThoseThatRenderWrites) {
    const std::vector<std::string> words = with({"cornell-box"}, GetParam());
    open(words);
    expectShown(rendered(words));
    quit();
}

INSTANTIATE_TEST_SUITE_P(Options, PicturesWith,
                         testing::Values(std::vector<std::string>{"--exposure", "auto"},
                                         std::vector<std::string>{"--background", "#3080ff"},
                                         std::vector<std::string>{"--background", "0.1,0.2,0.4"},
                                         std::vector<std::string>{"--ground", "#c02020", "--view",
                                                                  "three-quarter", "--env", "studio"},
                                         std::vector<std::string>{"--ground", "shadow", "--background",
                                                                  "#ffffff", "--view", "three-quarter",
                                                                  "--env", "studio"},
                                         std::vector<std::string>{"--env", "sky", "--sun-elevation", "20"}));

TEST_F(Pictures, NothingBehindTheSceneIsAChequeredGround) {
    const std::vector<std::string> words{"cornell-box", "--background", "transparent"};
    open(words);
    (void)rendered(words);
    const Picture cutOut = decodePicture(readFile(folder_ / "wanted.png"));
    std::vector<uint32_t> pixels;
    for (size_t i = 0; i < cutOut.bytes.size(); i += 4)
        pixels.push_back(uint32_t{cutOut.bytes[i]} | uint32_t{cutOut.bytes[i + 1]} << 8u |
                         uint32_t{cutOut.bytes[i + 2]} << 16u | uint32_t{cutOut.bytes[i + 3]} << 24u);
    putOnCheckerboard(pixels, cutOut.width, {cutOut.width, cutOut.height});
    expectShown(screenshotOf(pixels, cutOut.width));
    quit();
}

class DenoisedPictures : public ViewWindow {
  protected:
    void SetUp() override {
        try {
            const Denoiser denoiser;
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

TEST_F(DenoisedPictures, AreThoseOfRenderAndTheColourComesBack) {
    open({"cornell-box"});
    const Screenshot color = rendered({"cornell-box"});
    const Screenshot denoised = rendered({"cornell-box", "--denoise=fast"});
    ASSERT_TRUE(color != denoised);
    key("n");
    expectShown(denoised, "denoised");
    key("n");
    expectShown(color, "colour");
    key("n");
    expectShown(denoised, "denoised again");
    key("ctrl+s");
    ASSERT_TRUE(program_->waitForText("saved cornell-box-1.exr"));
    const ExrFile saved = readExr(folder_ / "cornell-box-1.exr");
    EXPECT_NE(saved.find("denoised"), nullptr);
    EXPECT_EQ(saved.find("guide-albedo"), nullptr);
    EXPECT_EQ(readPng(folder_ / "cornell-box-1.png"), denoised);
    quit();
}

TEST_F(DenoisedPictures, HaveTheShadowOnTheGround) {
    const std::vector<std::string> words{"cornell-box", "--ground",      "shadow", "--background", "#ffffff",
                                         "--view",      "three-quarter", "--env",  "studio"};
    open(with(words, {"--denoise"}));
    expectShown(rendered(with(words, {"--denoise=fast"})));
    quit();
}

TEST_F(DenoisedPictures, StandBesideThePictureAsItIs) {
    open({"cornell-box", "--denoise"});
    const Screenshot color = rendered({"cornell-box"});
    const Screenshot denoised = rendered({"cornell-box", "--denoise=fast"});
    expectShown(denoised);
    key("b");
    desktop_.input("mousemove --window " + window_ + " 30 90");
    key("n"); // on the left
    const auto isHalves = [&] {
        const Screenshot shown = desktop_.shoot(window_);
        for (uint32_t y = 0; y < shown.height; ++y)
            for (uint32_t x = 0; x < shown.width; ++x)
                if (const size_t i = size_t{y} * shown.width + x; x < 118 || x > 122)
                    if (shown.pixels[i] != (x < 120 ? color : denoised).pixels[i])
                        return false;
        return true;
    };
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!isHalves() && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_TRUE(isHalves());
    quit();
}

TEST_F(Pictures, WithoutADenoiserTheWindowSaysSoAndShowsTheColour) {
    const EnvironmentVariable nowhere("LAVALIGHT_OIDN", (folder_ / "nowhere").string());
    open({"cornell-box", "--denoise"});
    ASSERT_TRUE(program_->waitForText("cannot denoise: there is no"));
    key("n");
    EXPECT_TRUE(program_->isRunning());
    quit();
}

} // namespace
} // namespace lavalight::test
