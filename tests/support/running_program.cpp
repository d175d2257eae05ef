#include "support/running_program.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "support/spawn.h"

namespace lavalight::test {
namespace {

constexpr std::chrono::seconds kTimeAllowed(120);
constexpr std::chrono::milliseconds kTurn(2);

// Whether the process has a handler for the signal: a bit of the SigCgt mask that Linux shows of each
// process.
bool catches(pid_t process, int signal) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    const std::string key = "SigCgt:";
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(key))
            return (std::stoull(line.substr(key.size()), nullptr, 16) >> (signal - 1) & 1) != 0;
    return false;
}

pid_t start(const std::vector<std::string>& words, const std::filesystem::path& folder,
            const std::filesystem::path& out, const std::filesystem::path& err) {
    Spawn spawn;
    spawn.open(STDIN_FILENO, "/dev/null", O_RDONLY);
    spawn.open(STDOUT_FILENO, out, O_WRONLY | O_CREAT);
    spawn.open(STDERR_FILENO, err, O_WRONLY | O_CREAT);
    spawn.workIn(folder);
    return spawn.start(words);
}

int timesIn(const std::string& text, const std::string& part) {
    int times = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++times;
    return times;
}

} // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder)
    : deadline_(std::chrono::steady_clock::now() + kTimeAllowed) {
    std::vector<std::string> words = {LAVALIGHT_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    process_ = start(words, folder, printed_ / "out", printed_ / "err");
}

RunningProgram::~RunningProgram() {
    if (process_ != 0) {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
}

bool RunningProgram::hasEnded() {
    if (process_ != 0 && std::chrono::steady_clock::now() > deadline_)
        ::kill(process_, SIGKILL);
    int status = 0;
    if (process_ != 0 && ::waitpid(process_, &status, WNOHANG) == process_) {
        exitCode_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        process_ = 0;
    }
    return process_ == 0;
}

ProgramResult RunningProgram::result() const {
    return {exitCode_, readFile(printed_ / "out"), readFile(printed_ / "err")};
}

bool RunningProgram::waitForText(const std::string& text, int times) {
    for (;;) {
        const bool isLast = hasEnded(); // asked before reading: what the program wrote at its end counts
        const ProgramResult now = result();
        if (timesIn(now.out, text) + timesIn(now.err, text) >= times)
            return true;
        if (isLast)
            return false;
        std::this_thread::sleep_for(kTurn);
    }
}

void RunningProgram::waitUntilItCatchesInterrupts() {
    while (!hasEnded() && !catches(process_, SIGINT))
        std::this_thread::sleep_for(kTurn);
}

ProgramResult RunningProgram::interrupt() {
    waitUntilItCatchesInterrupts();
    return endWith(SIGINT);
}

ProgramResult RunningProgram::kill() {
    return endWith(SIGKILL);
}

void RunningProgram::send(int signal) {
    if (!hasEnded())
        ::kill(process_, signal);
}

ProgramResult RunningProgram::endWith(int signal) {
    send(signal);
    return wait();
}

ProgramResult RunningProgram::wait() {
    while (!hasEnded())
        std::this_thread::sleep_for(kTurn);
    return result();
}

} // namespace lavalight::test
