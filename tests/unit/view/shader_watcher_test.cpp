// Compiling shaders at every save, beside what goes on.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/temporary_folder.h"
#include "view/shader_watcher.h"

namespace lavalight {
namespace {

class ShaderWatcherTest : public testing::Test {
  protected:
    ShaderWatcherTest() {
        std::filesystem::create_directories(folder_ / "lib/sampling");
        save(ours_);
        watcher_ = std::make_unique<ShaderWatcher>(folder_.path().string(),
                                                   std::make_shared<ShaderOverlay>(folder_.path()),
                                                   ShaderWatcher::KernelNames{"path", "accumulate"}, [] {});
    }
    void save(const std::string& text) const {
        std::ofstream(folder_ / "lib/sampling/roulette.glsl") << text;
    }
    [[nodiscard]] std::string capped(const std::string& value) const {
        const std::string line = "kMaxSurvival = 0.95";
        std::string text = ours_;
        return text.replace(text.find(line), line.size(), "kMaxSurvival = " + value);
    }
    [[nodiscard]] ShaderWatcher::Change next() const {
        for (;;) {
            if (auto change = watcher_->take())
                return *change;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    const test::TemporaryFolder folder_;
    const std::string ours_{*embeddedShader("lib/sampling/roulette.glsl")};
    std::unique_ptr<ShaderWatcher> watcher_;
};

TEST_F(ShaderWatcherTest, BringsTheKernelsThatASaveChanges) {
    EXPECT_FALSE(watcher_->take());
    save(capped("0.5"));
    const ShaderWatcher::Change change = next();
    EXPECT_EQ(change.error, "");
    EXPECT_EQ(change.files, std::vector<std::string>{"lib/sampling/roulette.glsl"});
    EXPECT_EQ(change.kernels, std::vector<std::string>{"path"});
    ASSERT_NE(change.overlay, nullptr);
    EXPECT_NE(change.overlay->kernel("path").content, ShaderOverlay(folder_ / "lib").kernel("path").content);
    save("// The same code.\n" + capped("0.5"));
    const ShaderWatcher::Change none = next();
    EXPECT_TRUE(none.kernels.empty());
    EXPECT_EQ(none.overlay, nullptr);
}

TEST_F(ShaderWatcherTest, TellsWhatDoesNotCompileAndGoesOnFromTheLastThatDid) {
    save(capped(";"));
    const ShaderWatcher::Change broken = next();
    EXPECT_NE(broken.error.find("lib/sampling/roulette.glsl:"), std::string::npos) << broken.error;
    EXPECT_EQ(broken.overlay, nullptr);
    save(ours_);
    EXPECT_TRUE(next().kernels.empty()) << "it is what it was before the error";
}

TEST_F(ShaderWatcherTest, ComparesTheKernelsInUse) {
    watcher_->use({"extend", "shade"});
    save(capped("0.5"));
    EXPECT_EQ(next().kernels, std::vector<std::string>{"shade"});
}

// A second save, before anybody took the first, must not hide what that one changed.
TEST_F(ShaderWatcherTest, JoinsChangesThatNobodyTookYet) {
    save(capped("0.5"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    save(capped(";"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const ShaderWatcher::Change change = next();
    EXPECT_NE(change.error, "");
    EXPECT_EQ(change.kernels, std::vector<std::string>{"path"});
    EXPECT_NE(change.overlay, nullptr);
}

TEST(ShaderWatcher, NeedsItsFolder) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(ShaderWatcher((folder / "none").string(), nullptr, {}, [] {}), Error);
}

} // namespace
} // namespace lavalight
