// Checkpoints that cannot be written: it is told, the render goes on, and what was there before stays.
#include <chrono>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "base/file.h"
#include "film/film_file.h"
#include "support/full_disk.h"
#include "support/running_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using test::FullDisk;
using test::ProgramResult;
using test::runLavalight;
using test::RunningProgram;
using test::TemporaryFolder;

constexpr size_t kRoomForAPng = 4096; // holds 24 x 20 pixels, but not their film

class CheckpointFailure : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult render(const std::string& samples, const std::string& output) const {
        return runLavalight({"render", "--size", "24x20", "--samples", samples, "--checkpoint", "c.exr",
                             "--resume", output.ends_with("png") ? "--png" : "-o", output},
                            folder_.path());
    }

    const TemporaryFolder folder_;
};

TEST_F(CheckpointFailure, OnAFullDiskTheOneFromBeforeStaysAndTheImageIsWritten) {
    ASSERT_EQ(render("0:2", "a.png").exitCode, 0);
    const std::string before = readFile(folder_ / "c.exr");
    ASSERT_GT(before.size(), kRoomForAPng);
    ProgramResult result;
    {
        const FullDisk full(kRoomForAPng);
        result = render("0:4", "b.png");
    }
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("no checkpoint: cannot write c.exr"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("the images are written, the last checkpoint is not"), std::string::npos);
    EXPECT_EQ(readFile(folder_ / "c.exr"), before);
    EXPECT_TRUE(readFile(folder_ / "b.png").starts_with("\x89PNG"));
    EXPECT_EQ(folder_.count(), 3) << "a part of a file was left behind";
    EXPECT_EQ(render("0:4", "b.png").exitCode, 0) << "it goes on once there is room";
}

TEST_F(CheckpointFailure, OnAFullDiskAnImageIsWholeOrAbsent) {
    const FullDisk full(kRoomForAPng);
    const ProgramResult result = render("0:2", "a.exr");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("cannot write a.exr"), std::string::npos) << result.err;
    EXPECT_EQ(folder_.count(), 0);
}

TEST_F(CheckpointFailure, WithoutItsFolderTheImageIsWritten) {
    fs::create_directory(folder_ / "sub");
    RunningProgram program({"render", "--size", "24x20", "--samples", "0:100000000", "--wave-size", "4096",
                            "--checkpoint", "sub/c.exr", "--checkpoint-every", "0.01", "-o", "a.exr"},
                           folder_.path());
    while (!fs::exists(folder_ / "sub/c.exr") && !program.hasEnded())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::error_code busy; // a checkpoint may be in the making
    while (fs::remove_all(folder_ / "sub", busy), fs::exists(folder_ / "sub"))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(program.waitForText("no checkpoint: cannot write sub/c.exr", 2))
        << "it goes on, and tries again";
    const ProgramResult result = program.interrupt();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("the last checkpoint is not: cannot write sub/c.exr"), std::string::npos);
    EXPECT_FALSE(readFilmFile(folder_ / "a.exr").isComplete());
    EXPECT_EQ(folder_.count(), 1);
}

TEST_F(CheckpointFailure, ASecondRenderDoesNotTakeTheFirstOnesCheckpoint) {
    const std::vector<std::string> words{"render",       "--size", "24x20", "--samples", "0:100000000",
                                         "--checkpoint", "c.exr",  "-o",    "a.exr"};
    RunningProgram first(words, folder_.path());
    first.waitUntilItCatchesInterrupts();
    const ProgramResult second = runLavalight(words, folder_.path());
    EXPECT_EQ(second.exitCode, 1);
    EXPECT_TRUE(second.err.starts_with("lavalight: error: c.exr is in use by another process ("))
        << second.err;
    EXPECT_EQ(first.interrupt().exitCode, 130);
    EXPECT_TRUE(readFilmFile(folder_ / "c.exr").progress.samples > 0);
    EXPECT_EQ(folder_.count(), 2) << "a lock was left behind";
}

} // namespace
} // namespace lavalight
