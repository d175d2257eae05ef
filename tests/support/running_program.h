// Runs the lavalight binary beside the test, which watches and interrupts it.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {

// A program that is killed after two minutes, or when this is destroyed.
class RunningProgram {
  public:
    // Throws std::runtime_error if it cannot be started.
    RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    // Waits until the program has written that text to stdout or stderr, `times` times in all; false if it
    // ends before.
    [[nodiscard]] bool waitForText(const std::string& text, int times = 1);
    // Waits until the program catches SIGINT, which it does while it renders.
    void waitUntilItCatchesInterrupts();
    [[nodiscard]] bool isRunning() { return !hasEnded(); }
    // Waits for the program to end by itself.
    [[nodiscard]] ProgramResult wait();
    // Sends SIGINT as soon as the program catches it, and waits for the end.
    [[nodiscard]] ProgramResult interrupt();
    void send(int signal);
    // Ends the program at once by SIGKILL, unless it has ended.
    [[nodiscard]] ProgramResult kill();

    [[nodiscard]] bool hasEnded();

  private:
    [[nodiscard]] ProgramResult endWith(int signal);
    [[nodiscard]] ProgramResult result() const;

    TemporaryFolder printed_;
    std::chrono::steady_clock::time_point deadline_;
    pid_t process_ = 0; // 0: has ended
    int exitCode_ = -1;
};

} // namespace lavalight::test
