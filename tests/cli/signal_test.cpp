// Ends that a user or a system brings about: signals, streams that are closed, folders that go.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "base/file.h"
#include "image/exr.h"
#include "support/running_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

namespace fs = std::filesystem;

class Signals : public testing::Test {
  protected:
    [[nodiscard]] std::vector<std::string> longRender(const std::string& output) const {
        return {"render", "--size", "32x24", "--spp", "100000000", "-o", output};
    }
    // The program's exit code, started by a shell that redirects its streams.
    [[nodiscard]] int inShell(const std::string& words) const {
        const std::string line =
            "cd " + folder_.path().string() + " && exec " + LAVALIGHT_BINARY + " " + words;
        const int status = std::system(line.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    const TemporaryFolder folder_;
};

TEST_F(Signals, TerminationWritesTheImageSoFar) {
    RunningProgram program(longRender("a.exr"), folder_.path());
    program.waitUntilItCatchesInterrupts();
    program.send(SIGTERM);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.exitCode, 143) << result.err;
    const std::vector<uint32_t> counts = readExr(folder_ / "a.exr").sampleCounts;
    EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 0u);
    EXPECT_EQ(folder_.count(), 1);
}

TEST_F(Signals, ASecondInterruptDoesNotWaitForTheWave) {
    // The first wave takes several seconds: a kernel for whole paths, which leave the closed room late.
    RunningProgram program({"render", "many-lights", "--size", "512x512", "--spp", "1024", "--threads", "1",
                            "--schedule", "fused", "--roulette", "off", "--max-bounces", "1000", "-o",
                            "a.exr"},
                           folder_.path());
    program.waitUntilItCatchesInterrupts();
    program.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(100)); // signals of one kind are not counted
    const auto before = std::chrono::steady_clock::now();
    program.send(SIGINT);
    EXPECT_EQ(program.wait().exitCode, 130);
    EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
    EXPECT_EQ(folder_.count(), 0) << "nothing half-written";
}

TEST_F(Signals, AClosedStdoutFailsTheRunAndNotTheImage) {
    EXPECT_EQ(inShell("render --size 24x16 --spp 1 -o a.exr >&- 2>err.txt"), 1);
    EXPECT_EQ(readFile(folder_ / "err.txt"), "lavalight: error: cannot write the results to stdout\n");
    EXPECT_EQ(readExr(folder_ / "a.exr").radiance().width, 24u);
    EXPECT_EQ(inShell("info cornell-box >/dev/full 2>err.txt"), 1);
    EXPECT_EQ(readFile(folder_ / "err.txt"), "lavalight: error: cannot write the results to stdout\n");
}

TEST_F(Signals, AFolderThatGoesWhileItRendersIsTold) {
    fs::create_directory(folder_ / "sub");
    RunningProgram program(longRender("sub/a.exr"), folder_.path());
    program.waitUntilItCatchesInterrupts();
    fs::remove_all(folder_ / "sub");
    const ProgramResult result = program.interrupt();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("cannot write sub/a.exr"), std::string::npos) << result.err;
    EXPECT_EQ(folder_.count(), 0);
}

} // namespace
} // namespace lavalight::test
