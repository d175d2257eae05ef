// A window of the program on a desktop in memory, for tests.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "support/desktop/desktop.h"
#include "support/run_program.h"
#include "support/running_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {

inline constexpr std::chrono::seconds kPatience(60);

// Samples that are soon taken, and how a title says so.
inline const std::vector<std::string> kSamples{"--spp", "8"};
inline const std::vector<std::string> kSmall{"--size", "240x180"};
inline constexpr const char* kDone = "8 samples, done";

class ViewWindow : public testing::Test {
  protected:
    [[nodiscard]] static std::vector<std::string> with(std::vector<std::string> words,
                                                       const std::vector<std::string>& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    // Opens the window, validated, and hides its panel.
    void open(const std::vector<std::string>& words, const std::vector<std::string>& size = kSmall) {
        program_ = std::make_unique<RunningProgram>(
            with({"view", "--validate"}, with(kSamples, with(size, words))), folder_.path());
        window_ = desktop_.findWindow("Lavalight");
        waitFor(kDone);
        key("Tab");
    }
    void waitFor(const std::string& title) {
        const auto deadline = std::chrono::steady_clock::now() + kPatience;
        while (desktop_.titleOf(window_).find(title) == std::string::npos) {
            ASSERT_LT(std::chrono::steady_clock::now(), deadline)
                << "\"" << desktop_.titleOf(window_) << "\" never says \"" << title << "\"";
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }
    void key(const std::string& name) const {
        desktop_.input("windowfocus --sync " + window_ + " key --clearmodifiers " + name);
    }
    // Waits for the window to show those pixels; says how they differ if it does not.
    void expectShown(const Screenshot& wanted, const std::string& what = "") const {
        const auto deadline = std::chrono::steady_clock::now() + kPatience;
        Screenshot shown = desktop_.shoot(window_);
        while (shown != wanted && std::chrono::steady_clock::now() < deadline) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            shown = desktop_.shoot(window_);
        }
        ASSERT_EQ(shown.width, wanted.width);
        ASSERT_EQ(shown.height, wanted.height);
        size_t different = 0;
        for (size_t i = 0; i < shown.pixels.size(); ++i)
            different += shown.pixels[i] != wanted.pixels[i];
        EXPECT_EQ(different, 0u) << what << ": pixels of " << shown.pixels.size();
    }
    // What `lavalight render` makes of the same scene and settings.
    [[nodiscard]] Screenshot rendered(const std::vector<std::string>& words,
                                      const std::vector<std::string>& size = kSmall) const {
        const ProgramResult result = runLavalight(
            with({"render", "--png", "wanted.png"}, with(kSamples, with(size, words))), folder_.path());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return readPng(folder_ / "wanted.png");
    }
    // Closes it by the keyboard, and expects that nothing was wrong.
    void quit() {
        key("ctrl+q");
        const ProgramResult result = program_->wait();
        EXPECT_EQ(result.exitCode, 0) << result.err;
    }

    const TemporaryFolder folder_;
    const Desktop desktop_;
    std::unique_ptr<RunningProgram> program_;
    std::string window_;
};

} // namespace lavalight::test
