// Settings: ranges, names and what the image's header says of them.
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "render/presets.h"
#include "render/setting_names.h"
#include "render/settings.h"

namespace lavalight {
namespace {

RenderSettings goodSettings() {
    RenderSettings settings;
    settings.image.width = 640;
    settings.image.height = 480;
    return settings;
}

// What checkSettings says; empty if it is content.
std::string complaint(const RenderSettings& settings) {
    try {
        checkSettings(settings);
    } catch (const UsageError& error) {
        return error.what();
    }
    return {};
}

template <typename Change>
void expectRefusal(const std::string& option, const Change& change) {
    RenderSettings settings = goodSettings();
    change(settings);
    const std::string message = complaint(settings);
    EXPECT_TRUE(message.starts_with(option)) << option << ": " << message;
    EXPECT_NE(message.find("range"), std::string::npos) << message;
}

TEST(Settings, DefaultsAndLimitsAreAccepted) {
    EXPECT_EQ(complaint(goodSettings()), "");
    RenderSettings settings = goodSettings();
    settings.image.width = settings.image.height = kMaxImageSide;
    settings.estimator.maxBounces = kMaxBounceLimit;
    settings.stop.samples = settings.estimator.rouletteStart = 0x7fffffff;
    EXPECT_EQ(complaint(settings), "");
    settings.image.width = settings.image.height = settings.stop.samples = settings.estimator.rouletteStart =
        1;
    settings.estimator.maxBounces = 0;
    settings.work.waveSize = 64;
    EXPECT_EQ(complaint(settings), "");
}

TEST(Settings, WhatIsOutOfRangeIsRefusedByItsOptionsName) {
    expectRefusal("--size", [](RenderSettings& s) { s.image.width = 0; });
    expectRefusal("--size", [](RenderSettings& s) { s.image.height = 0; });
    expectRefusal("--size", [](RenderSettings& s) { s.image.width = kMaxImageSide + 1; });
    expectRefusal("--size", [](RenderSettings& s) { s.image.height = 100'000; });
    expectRefusal("--spp", [](RenderSettings& s) { s.stop.samples = 0; });
    expectRefusal("--spp", [](RenderSettings& s) { s.stop.samples = 0x80000000u; });
    expectRefusal("--wave-size", [](RenderSettings& s) { s.work.waveSize = 63; });
    expectRefusal("--wave-size", [](RenderSettings& s) { s.work.waveSize = 4'000'001; });
    expectRefusal("--max-bounces", [](RenderSettings& s) { s.estimator.maxBounces = kMaxBounceLimit + 1; });
    expectRefusal("--roulette-start", [](RenderSettings& s) { s.estimator.rouletteStart = 0; });
    expectRefusal("--roulette-probability",
                  [](RenderSettings& s) { s.estimator.rouletteProbability = 0.0f; });
    expectRefusal("--roulette-probability",
                  [](RenderSettings& s) { s.estimator.rouletteProbability = 1.01f; });
    expectRefusal("--time", [](RenderSettings& s) { s.stop.seconds = -1.0; });
    expectRefusal("--target-error", [](RenderSettings& s) { s.stop.targetError = -0.1; });
}

TEST(Settings, MisSurvivalNeedsARouletteThatDoesNotKnowTheDirection) {
    RenderSettings settings = goodSettings();
    settings.estimator.misSurvival = true;
    for (const Roulette roulette :
         {Roulette::cbrtThroughput, Roulette::sqrtThroughput, Roulette::throughput, Roulette::off}) {
        settings.estimator.roulette = roulette;
        EXPECT_TRUE(complaint(settings).starts_with("--mis-survival")) << complaint(settings);
    }
    for (const Roulette roulette : {Roulette::constant, Roulette::meanAlbedo, Roulette::maxAlbedo}) {
        settings.estimator.roulette = roulette;
        EXPECT_EQ(complaint(settings), "");
    }
}

TEST(Presets, ChangeOneThingAStepAndEndAtTheDefaults) {
    EXPECT_FALSE(findPreset("naive").settings.nextEventEstimation);
    EXPECT_EQ(findPreset("naive").settings.hemisphere, Hemisphere::uniform);
    EXPECT_EQ(findPreset("cosine").settings.hemisphere, Hemisphere::cosine);
    EXPECT_TRUE(findPreset("nee").settings.nextEventEstimation);
    EXPECT_EQ(findPreset("nee").settings.mis, Mis::off);
    EXPECT_EQ(findPreset("mis").settings.mis, Mis::power);
    EXPECT_EQ(findPreset("mis").settings.roulette, Roulette::off);
    EXPECT_EQ(findPreset("roulette").settings.roulette, Roulette::throughput);
    EXPECT_EQ(findPreset("reference").settings.sampler, EstimatorSettings().sampler);
    EXPECT_EQ(presets().size(), 6u);
}

TEST(Presets, TellTheOptionsThatTheySet) {
    EXPECT_EQ(optionsOf(findPreset("naive")), "--sampler independent --hemisphere uniform --nee off "
                                              "--light-selection power --roulette off");
    EXPECT_EQ(optionsOf(findPreset("nee")), "as cosine, with --nee on --mis off");
    EXPECT_EQ(optionsOf(findPreset("reference")),
              "all defaults: as roulette, with --sampler sobol --light-selection auto --roulette "
              "cbrt-throughput");
}

TEST(Presets, AnUnknownOneIsRefusedWithThoseThereAre) {
    try {
        (void)findPreset("best");
        FAIL() << "no error";
    } catch (const UsageError& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with("--preset")) << message;
        for (const Preset& preset : presets())
            EXPECT_NE(message.find(preset.name), std::string::npos) << message;
    }
}

std::map<std::string, std::string> described(const RenderSettings& settings) {
    const auto pairs = describe(settings);
    std::map<std::string, std::string> map(pairs.begin(), pairs.end());
    EXPECT_EQ(map.size(), pairs.size()) << "an option is named twice";
    return map;
}

TEST(Settings, DescriptionNamesEveryOptionWithItsValue) {
    RenderSettings settings = goodSettings();
    settings.stop.samples = 100;
    settings.image.firstSample = 28;
    settings.estimator.seed = 5;
    settings.estimator.nextEventEstimation = false;
    settings.estimator.mis = Mis::balance;
    settings.estimator.roulette = Roulette::off;
    settings.estimator.rouletteStart = 9;
    settings.estimator.maxBounces = 12;
    settings.lighting.constant = {0.5f, 1.0f, 2.25f};
    const auto options = described(settings);
    EXPECT_EQ(options.at("size"), "640x480");
    EXPECT_EQ(options.at("spp"), "100");
    EXPECT_EQ(options.at("first-sample"), "28");
    EXPECT_EQ(options.at("seed"), "5");
    EXPECT_EQ(options.at("nee"), "off");
    EXPECT_EQ(options.at("mis"), "balance");
    EXPECT_EQ(options.at("roulette"), "off");
    EXPECT_EQ(options.at("roulette-start"), "9");
    EXPECT_EQ(options.at("max-bounces"), "12");
    EXPECT_EQ(options.at("env"), "0.5,1,2.25");
}

TEST(Settings, GroundIsNamedAndBringsThePlanesOfItsShadow) {
    RenderSettings settings = goodSettings();
    EXPECT_EQ(described(settings).count("ground"), 0u);
    settings.ground = {Ground::lambert, 0x0a80ff};
    EXPECT_EQ(described(settings).at("ground"), "#0a80ff");
    EXPECT_EQ(filmPlanes(settings), 1u << kColorPlane);
    settings.ground = {Ground::shadow, 0};
    EXPECT_EQ(described(settings).at("ground"), "shadow");
    EXPECT_EQ(filmPlanes(settings), 1u << kColorPlane | 1u << kShadowPlane | 1u << kBehindPlane);
    settings.background.kind = Background::transparent;
    EXPECT_EQ(filmPlanes(settings), 1u << kColorPlane | 1u << kCoveragePlane | 1u << kShadowPlane);
}

TEST(Settings, DescriptionNamesTheMapAndHowItIsUsed) {
    RenderSettings settings = goodSettings();
    settings.lighting.mapFile = "garden.hdr";
    settings.lighting.rotation = 12.5f;
    settings.lighting.intensity = 3.0f;
    const auto options = described(settings);
    EXPECT_EQ(options.at("env"), "garden.hdr");
    EXPECT_EQ(options.at("env-rotation"), "12.5");
    EXPECT_EQ(options.at("env-intensity"), "3");
}

TEST(Settings, DescriptionOfTheScenesOwnEnvironmentNamesNone) {
    EXPECT_EQ(described(goodSettings()).count("env"), 0u);
}

// What does not decide the bits must not make two headers differ.
TEST(Settings, DescriptionLeavesOutHowTheWorkIsCutUp) {
    RenderSettings settings = goodSettings();
    settings.work.waveSize = 4096;
    settings.work.bandRows = 3;
    EXPECT_EQ(described(settings), described(goodSettings()));
}

} // namespace
} // namespace lavalight
