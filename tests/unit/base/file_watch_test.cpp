// Saves are noticed as editors make them: in place, by renaming, in new folders; with inotify and without.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/os/file_watch.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using Paths = std::vector<std::string>;

class FileWatchTest : public testing::TestWithParam<FileWatch::Means> {
  protected:
    void write(const std::string& path, const std::string& text) const {
        fs::create_directories((folder_ / path).parent_path());
        std::ofstream(folder_ / path) << text;
    }

    TemporaryFolder folder_;
};

TEST_P(FileWatchTest, NothingIsToldWhereNothingChanges) {
    write("lib/a.glsl", "1");
    FileWatch watch(folder_.path(), GetParam());
    EXPECT_EQ(watch.wait(milliseconds(0)), Paths{});
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(watch.wait(milliseconds(150)), Paths{});
    EXPECT_GE(std::chrono::steady_clock::now() - start, milliseconds(140));
}

TEST_P(FileWatchTest, SavesAreToldOnceByTheirPaths) {
    write("lib/a.glsl", "1");
    write("lib/b.glsl", "1");
    FileWatch watch(folder_.path(), GetParam());
    write("lib/b.glsl", "22");
    write("kernels/new.comp", "1");
    EXPECT_EQ(watch.wait(milliseconds(5000)), (Paths{"kernels/new.comp", "lib/b.glsl"}));
    EXPECT_EQ(watch.wait(milliseconds(0)), Paths{});
}

TEST_P(FileWatchTest, RenamingIsASaveToo) {
    write("lib/a.glsl", "1");
    FileWatch watch(folder_.path(), GetParam());
    write("lib/.a.swp", "22");
    fs::rename(folder_ / "lib/.a.swp", folder_ / "lib/a.glsl");
    EXPECT_EQ(watch.wait(milliseconds(5000)), Paths{"lib/a.glsl"});
    fs::remove(folder_ / "lib/a.glsl");
    EXPECT_EQ(watch.wait(milliseconds(5000)), Paths{"lib/a.glsl"});
}

TEST_P(FileWatchTest, FoldersMadeLaterAreWatched) {
    FileWatch watch(folder_.path(), GetParam());
    write("lib/deep/a.glsl", "1");
    EXPECT_EQ(watch.wait(milliseconds(5000)), Paths{"lib/deep/a.glsl"});
    write("lib/deep/a.glsl", "22");
    EXPECT_EQ(watch.wait(milliseconds(5000)), Paths{"lib/deep/a.glsl"});
}

INSTANTIATE_TEST_SUITE_P(Means, FileWatchTest,
                         testing::Values(FileWatch::Means::automatic, FileWatch::Means::polling),
                         [](const auto& means) {
                             return means.param == FileWatch::Means::polling ? "polling" : "automatic";
                         });

TEST(FileWatch, AMissingFolderIsNamed) {
    EXPECT_THROW(FileWatch("/nowhere/at/all"), Error);
}

} // namespace
} // namespace lavalight::test
