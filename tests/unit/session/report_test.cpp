// Ledger, JSON report and EXR header of a render.
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "film/film_identity.h"
#include "render/setting_table.h"
#include "session/report.h"
#include "support/changed_setting.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

TEST(Ledger, UnbiasedImageHasNoEntry) {
    const auto ledger = makeLedger(Scene(), RenderSettings(), FilmTallies(), StopReason::samples);
    EXPECT_TRUE(ledger.empty());
    EXPECT_EQ(ledgerText(ledger), "none");
}

TEST(Ledger, NamesEveryCauseWithItsFigures) {
    Scene scene;
    scene.ignoredExtensions = {"KHR_a", "EXT_b"};
    scene.coarse = {.distance = 1e7, .resolution = 1.0, .size = 2.0};
    scene.meshes.resize(2);
    scene.meshes[1].name = "ice";
    scene.solids = {{1, {}}};
    scene.openSolids = {"wax", "pond"};
    const FilmTallies tallies{11, 22, 33, 0.25, 44, 1, 55, 66};
    const auto ledger = makeLedger(scene, RenderSettings(), tallies, StopReason::samples);
    ASSERT_EQ(ledger.size(), 9u);
    const std::map<std::string, std::string> figures{{"dropped-samples", "11"},
                                                     {"saturated-sums", "22"},
                                                     {"cut-paths", "33"},
                                                     {"crowded-solids", "44 paths"},
                                                     {"open-solids", "wax, pond"},
                                                     {"negative-samples", "55 samples were negative"},
                                                     {"limited-values", "66 values"},
                                                     {"ignored-extensions", "KHR_a, EXT_b"},
                                                     {"coarse-geometry", "steps of 1 m"}};
    for (const LedgerEntry& entry : ledger)
        EXPECT_NE(entry.detail.find(figures.at(entry.cause)), std::string::npos)
            << entry.cause << ": " << entry.detail;
    EXPECT_TRUE(crowdedText(scene, tallies).starts_with("\"ice\" lies within"));
    const std::string text = ledgerText(ledger);
    EXPECT_NE(text.find("0.25"), std::string::npos) << text;
    EXPECT_NE(text.find("; "), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(Ledger, ShadowsOnTheGroundAreARatio) {
    RenderSettings settings;
    settings.ground.kind = Ground::lambert;
    EXPECT_TRUE(makeLedger(Scene(), settings, FilmTallies(), StopReason::samples).empty());
    settings.ground.kind = Ground::shadow;
    const auto ledger = makeLedger(Scene(), settings, FilmTallies(), StopReason::samples);
    ASSERT_EQ(ledger.size(), 1u);
    EXPECT_EQ(ledger.front().cause, "shadow-catcher");
}

TEST(Ledger, OneCauseIsOneEntry) {
    FilmTallies tallies;
    tallies.droppedSamples = 3;
    const auto ledger = makeLedger(Scene(), RenderSettings(), tallies, StopReason::samples);
    ASSERT_EQ(ledger.size(), 1u);
    EXPECT_EQ(ledgerText(ledger), ledger.front().cause + ": " + ledger.front().detail);
}

// What was asked for that biases the image, and lights that a setting cannot reach.
TEST(Ledger, NamesBiasedSettings) {
    Scene scene;
    scene.punctualLights.resize(2);
    RenderSettings settings;
    settings.estimator.clampIndirect = 7.5f;
    settings.estimator.nextEventEstimation = false;
    settings.stop.targetError = 0.125;
    const std::string text = ledgerText(makeLedger(scene, settings, FilmTallies(), StopReason::targetError));
    EXPECT_NE(text.find("clamp-indirect: indirect light was limited to 7.5"), std::string::npos) << text;
    EXPECT_NE(text.find("unreachable-lights: --nee off cannot find 2"), std::string::npos) << text;
    EXPECT_NE(text.find("stopped-on-estimate: the error estimate reached 0.125"), std::string::npos) << text;
    EXPECT_EQ(makeLedger(scene, RenderSettings(), FilmTallies(), StopReason::time).size(), 0u);
}

RenderReport exampleReport() {
    RenderReport report;
    report.scene = "some \"scene\".gltf";
    report.camera = "cam\xff"; // no valid UTF-8
    report.settings.image.width = 20;
    report.settings.image.height = 10;
    report.settings.stop.samples = 6;
    report.device.name = "device";
    report.device.driver = "driver 1.2";
    report.device.type = "CPU";
    report.device.apiVersion = "1.3.0";
    report.stages = {{"load", 0.5}, {"render", 2.0}};
    report.renderSeconds = 2.0;
    report.kernels["shade"] = {1.25, 65};
    report.rays = {100, 200, 300};
    report.samples = 1200;
    report.sceneBytes = 5000;
    report.peakDeviceBytes = 6000;
    report.triangles = 32;
    report.ledger = {{"cut-paths", "4 paths"}};
    report.warnings = {"first", "second"};
    report.meanRadiance = {0.1, 0.2, 0.3};
    return report;
}

// Films of the two settings, by their headers; empty if they may be merged.
std::string differencesOf(const EstimatorSettings& a, const EstimatorSettings& b) {
    RenderReport report = exampleReport();
    report.settings.estimator = a;
    const Metadata first = exrMetadata(report);
    report.settings.estimator = b;
    const Metadata second = exrMetadata(report);
    return differences({first, "a"}, {second, "b"});
}

TEST(Report, FilmsThatDifferInASettingThatDecidesBitsAreNotMerged) {
    EXPECT_EQ(differencesOf({}, {}), "");
    for (const SettingRow& row : settingRows()) {
        const std::string difference = differencesOf({}, test::withAnother(row));
        EXPECT_EQ(difference.starts_with("--" + std::string(row.name) + " ("), row.decidesBits)
            << row.name << ": " << difference;
    }
}

TEST(Report, IsJsonWithWhatTheRenderWasAndCost) {
    const Json json = Json::parse(reportJson(exampleReport()));
    EXPECT_EQ(json.at("scene"), "some \"scene\".gltf");
    EXPECT_EQ(json.at("triangles"), 32);
    EXPECT_EQ(json.at("device").at("name"), "device");
    EXPECT_EQ(json.at("device").at("driver"), "driver 1.2");
    EXPECT_EQ(json.at("settings").at("spp"), "6");
    EXPECT_EQ(json.at("phases"), Json::array({{{"transport", "path"}, {"firstSample", 0}, {"samples", 6}}}));
    EXPECT_EQ(json.at("complete"), true);
    EXPECT_EQ(json.at("seconds").at("load"), 0.5);
    EXPECT_EQ(json.at("kernels").at("shade").at("seconds"), 1.25);
    EXPECT_EQ(json.at("kernels").at("shade").at("dispatches"), 65);
    EXPECT_EQ(json.at("rays").at("camera"), 100);
    EXPECT_EQ(json.at("rays").at("indirect"), 200);
    EXPECT_EQ(json.at("rays").at("shadow"), 300);
    EXPECT_EQ(json.at("rays").at("perSecond"), 300.0);
    EXPECT_EQ(json.at("samples").at("total"), 1200);
    EXPECT_EQ(json.at("samples").at("perSecond"), 600.0);
    EXPECT_EQ(json.at("samples").at("dropped"), 0);
    EXPECT_EQ(json.at("memory").at("sceneBytes"), 5000);
    EXPECT_EQ(json.at("memory").at("peakDeviceBytes"), 6000);
    EXPECT_EQ(json.at("meanRadiance"), Json::array({0.1, 0.2, 0.3}));
    EXPECT_EQ(json.at("ledger"), Json::array({{{"cause", "cut-paths"}, {"detail", "4 paths"}}}));
    EXPECT_EQ(json.at("warnings"), Json::array({"first", "second"}));
    EXPECT_EQ(json.at("version"), kVersion);
    EXPECT_EQ(json.at("commit"), kCommit);
    EXPECT_TRUE(json.contains("camera"));
    EXPECT_TRUE(json.contains("waveSize"));
}

TEST(Report, RenderOfNoTimeHasNoInfiniteRates) {
    RenderReport report = exampleReport();
    report.renderSeconds = 0.0;
    const Json json = Json::parse(reportJson(report));
    EXPECT_EQ(json.at("rays").at("perSecond"), 0.0);
    EXPECT_EQ(json.at("samples").at("perSecond"), 0.0);
}

std::map<std::string, std::string> headerOf(const RenderReport& report) {
    const Metadata metadata = exrMetadata(report);
    std::map<std::string, std::string> map(metadata.begin(), metadata.end());
    EXPECT_EQ(map.size(), metadata.size()) << "a key is there twice";
    return map;
}

TEST(ExrHeader, SaysHowTheImageCameToBe) {
    const auto header = headerOf(exampleReport());
    EXPECT_EQ(header.at("scene"), "some \"scene\".gltf");
    EXPECT_EQ(header.at("device"), "device");
    EXPECT_EQ(header.at("driver"), "driver 1.2");
    EXPECT_EQ(header.at("samples-per-pixel"), "6");
    EXPECT_EQ(header.at("render-seconds"), "2.000");
    EXPECT_EQ(header.at("complete"), "yes");
    EXPECT_EQ(header.at("bias-ledger"), "cut-paths: 4 paths");
    EXPECT_EQ(header.count("camera"), 1u);
    EXPECT_EQ(header.at("version"), kVersion);
    EXPECT_EQ(header.count("commit"), kCommit.empty() ? 0u : 1u);
    for (const auto& [name, value] : describe(exampleReport().settings))
        EXPECT_EQ(header.at("option:" + name), value);
}

TEST(ExrHeader, InterruptedRenderSaysSoWithItsOwnSampleCount) {
    RenderReport report = exampleReport();
    report.stop = StopReason::interrupted;
    report.samples = 300;
    const auto header = headerOf(report);
    EXPECT_EQ(header.at("complete"), "no, interrupted");
    EXPECT_EQ(header.at("samples-per-pixel"), "1.5");
    EXPECT_EQ(header.at("option:spp"), "6");
    EXPECT_EQ(Json::parse(reportJson(report)).at("complete"), false);
}

} // namespace
} // namespace lavalight
