// The window, on a desktop in memory: what it shows is what render writes, and it does what its user asks.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "base/file.h"
#include "image/exr.h"
#include "support/faults/faults.h"
#include "window/view_window.h"

namespace lavalight::test {
namespace {

using View = ViewWindow;

TEST_F(View, ShowsWhatRenderWrites) {
    const std::vector<std::string> words{"cornell-box", "--tonemap", "agx", "--exposure", "1"};
    open(words);
    expectShown(rendered(words));
    quit();
}

TEST_F(View, IsMovedByMouseAndKeysAndComesHome) {
    open({"cornell-box"});
    const Screenshot home = rendered({"cornell-box"});
    expectShown(home);
    desktop_.input("mousemove --window " + window_ +
                   " 120 90 mousedown 1 sleep 0.1 mousemove_relative 12 0 sleep 0.1 mousemove_relative 12 4 "
                   "sleep 0.1 mouseup 1");
    waitFor(kDone);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    waitFor(kDone);
    const Screenshot orbited = desktop_.shoot(window_);
    EXPECT_TRUE(orbited != home);
    desktop_.input("windowfocus --sync " + window_ + " keydown w sleep 0.3 keyup w");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    waitFor(kDone);
    EXPECT_TRUE(desktop_.shoot(window_) != orbited);
    key("Home");
    expectShown(home);
    quit();
}

TEST_F(View, FollowsItsSize) {
    open({"cornell-box"});
    desktop_.input("windowsize --sync " + window_ + " 320 200");
    expectShown(rendered({"cornell-box"}, {"--size", "320x200"}));
    quit();
}

TEST_F(View, SettingsOfThePanelRestartTheImage) {
    const std::vector<std::string> size{"--size", "400x600"};
    open({"cornell-box"}, size);
    expectShown(rendered({"cornell-box"}, size));
    key("Tab");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    desktop_.input("mousemove --window " + window_ + " 60 67 sleep 0.2 click 1"); // closes "View"
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    desktop_.input("mousemove --window " + window_ + " 30 483 sleep 0.2 click 1"); // next-event estimation
    key("Tab");
    expectShown(rendered({"cornell-box", "--nee", "off"}, size));
    quit();
}

TEST_F(View, ComparesTwoSettingsSideBySide) {
    open({"cornell-box"});
    key("b");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    waitFor(kDone);
    const Screenshot one = rendered({"cornell-box"});
    const Screenshot two = desktop_.shoot(window_); // equal settings: equal pixels but for the line
    size_t different = 0;
    for (size_t i = 0; i < one.pixels.size(); ++i)
        different += one.pixels[i] != two.pixels[i];
    EXPECT_GE(different, one.height / 2);
    EXPECT_LE(different, size_t{2} * one.height);
    key("b");
    expectShown(one);
    quit();
}

TEST_F(View, OpensWhatIsDroppedAndKeepsTheSceneWhereThatIsBroken) {
    open({"cornell-box"});
    std::ofstream(folder_ / "broken.gltf") << "{";
    desktop_.drop((folder_ / "broken.gltf").string(), window_);
    ASSERT_TRUE(program_->waitForText("broken.gltf"));
    const std::string scene = LAVALIGHT_SOURCE_DIR "/assets/furnace.gltf";
    desktop_.drop(scene, window_);
    waitFor("furnace.gltf");
    waitFor(kDone);
    EXPECT_TRUE(program_->isRunning());
    quit();
}

// A map of two texels of RGBE: a blue and a brighter, yellow one.
std::string writtenSky(const TemporaryFolder& folder) {
    std::ofstream(folder / "sky.hdr", std::ios::binary)
        << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x20\x20\xc0\x80\xc0\xc0\x20\x82";
    return (folder / "sky.hdr").string();
}

TEST_F(View, IsLitByAMapThatIsDropped) {
    const std::string sky = writtenSky(folder_);
    open({"cornell-box"});
    const Screenshot lit = rendered({"cornell-box", "--env", sky});
    ASSERT_TRUE(lit != rendered({"cornell-box"}));
    desktop_.drop(sky, window_);
    expectShown(lit);
    quit();
}

TEST_F(View, GroundStaysUnderAnotherLight) {
    const std::string sky = writtenSky(folder_);
    const std::vector<std::string> words{"cornell-box", "--ground", "#c02020", "--view", "three-quarter"};
    open(words);
    const Screenshot lit = rendered(with(words, {"--env", sky}));
    desktop_.drop(sky, window_);
    expectShown(lit);
    quit();
}

TEST_F(View, SavesTheImageAsRenderWritesIt) {
    open({"cornell-box"});
    key("ctrl+s");
    ASSERT_TRUE(program_->waitForText("saved cornell-box-1.exr, cornell-box-1.png"));
    const ProgramResult result = runLavalight(
        with({"render", "cornell-box", "-o", "wanted.exr"}, with(kSamples, kSmall)), folder_.path());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const ExrFile saved = readExr(folder_ / "cornell-box-1.exr");
    const ExrFile wanted = readExr(folder_ / "wanted.exr");
    EXPECT_EQ(saved.radiance().pixels, wanted.radiance().pixels);
    EXPECT_EQ(saved.sampleCounts, wanted.sampleCounts);
    EXPECT_EQ(readPng(folder_ / "cornell-box-1.png"), rendered({"cornell-box"}));
    quit();
}

TEST_F(View, SavesWhereTheCameraIs) {
    const auto hasLookFrom = [](const Metadata& metadata) {
        return std::any_of(metadata.begin(), metadata.end(),
                           [](const auto& pair) { return pair.first == "option:look-from"; });
    };
    open({"cornell-box"});
    desktop_.input("mousemove --window " + window_ + " 120 90 click 4"); // the wheel: nearer
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    waitFor(kDone);
    key("ctrl+s");
    ASSERT_TRUE(program_->waitForText("saved cornell-box-1.exr"));
    EXPECT_TRUE(hasLookFrom(readExr(folder_ / "cornell-box-1.exr").metadata));
    key("Home");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    waitFor(kDone);
    key("ctrl+s");
    ASSERT_TRUE(program_->waitForText("saved cornell-box-2.exr"));
    EXPECT_FALSE(hasLookFrom(readExr(folder_ / "cornell-box-2.exr").metadata));
    quit();
}

TEST_F(View, CompilesShadersAtEverySaveAndGoesOnWhereTheyAreBroken) {
    const std::string file = (folder_ / "mine/lib/sampling/roulette.glsl").string();
    ASSERT_EQ(runLavalight({"new-experiment", "mine", "lib/sampling/roulette.glsl"}, folder_.path()).exitCode,
              0);
    const std::string ours = readFile(file);
    const auto save = [&](const std::string& cap) {
        std::string text = ours;
        const std::string line = "kMaxSurvival = 0.95";
        text.replace(text.find(line), line.size(), "kMaxSurvival = " + cap);
        std::ofstream(file) << text;
    };
    const std::vector<std::string> words{"cornell-box", "--shaders", "mine"};
    open(words);
    expectShown(rendered({"cornell-box"}));
    save(";");
    ASSERT_TRUE(program_->waitForText("mine/lib/sampling/roulette.glsl:6"));
    save("0.2");
    ASSERT_TRUE(program_->waitForText("changed: hosted/escape, hosted/scatter"));
    waitFor(kDone);
    save("0.95");
    ASSERT_TRUE(program_->waitForText("changed: hosted/escape, hosted/scatter", 2));
    quit();
}

TEST_F(View, IsClosedByItsFrame) {
    open({"cornell-box"});
    desktop_.input("windowfocus --sync " + window_ + " key --clearmodifiers alt+F4");
    EXPECT_EQ(program_->wait().exitCode, 0);
}

// Ends by itself, with that in its only line.
void expectRefusal(const std::string& words) {
    const TemporaryFolder folder;
    const ProgramResult result = runLavalight({"view", "cornell-box", "--size", "120x90"}, folder.path());
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("unexpected"), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(ViewRefusals, WithoutADesktopSaysSoInALine) {
    const EnvironmentVariable nowhere("DISPLAY", ":4711");
    expectRefusal("is there a desktop here");
}

TEST(ViewRefusals, WithoutADeviceThatPresentsSaysSoInALine) {
    const Desktop desktop;
    const VulkanFault hidden("hidden");
    expectRefusal("cannot draw on this window: no Vulkan device shows pictures on it");
}

TEST(ViewRefusals, OfALostDeviceIsOneLine) {
    const Desktop desktop;
    const TemporaryFolder folder;
    const std::string log = (folder / "calls.txt").string();
    {
        const VulkanFault late("1500 -4", log); // well into its pictures
        expectRefusal("DeviceLost");
    }
    std::istringstream calls(readFile(log));
    std::set<std::string> seen;
    int count = 0;
    for (std::string call; std::getline(calls, call) && count < 1500;) {
        ++count;
        if (!seen.insert(call).second)
            continue; // each kind of call, where it comes first
        SCOPED_TRACE(call);
        const VulkanFault lost(std::to_string(count) + " -4");
        expectRefusal("DeviceLost");
    }
    EXPECT_GT(seen.size(), 25u);
}

TEST(ViewRefusals, RendersUntilItIsClosed) {
    const TemporaryFolder folder;
    EXPECT_EQ(runLavalight({"view", "cornell-box", "--time", "3"}, folder.path()).exitCode, 2);
}

} // namespace
} // namespace lavalight::test
