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

// Killed after two minutes, or when destroyed.
class RunningProgram {
  public:
    // Throws std::runtime_error if it cannot be started.
    RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    // Waits until it has written that text to stdout or stderr, `times` times in all; false if it ends
    // before.
    [[nodiscard]] bool waitForText(const std::string& text, int times = 1);
    // Which it does while it renders.
    void waitUntilItCatchesInterrupts();
    [[nodiscard]] bool isRunning() { return !hasEnded(); }
    // Waits for it to end by itself.
    [[nodiscard]] ProgramResult wait();
    // Sends SIGINT as soon as the program catches it, and waits for the end.
    [[nodiscard]] ProgramResult interrupt();
    void send(int signal);
    // Ends it at once, unless it has ended: SIGKILL.
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
