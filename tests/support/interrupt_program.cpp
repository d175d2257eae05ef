#include "support/interrupt_program.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

constexpr std::chrono::seconds kTimeAllowed(120);

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

pid_t start(std::vector<std::string> words, const std::filesystem::path& folder,
            const std::filesystem::path& out, const std::filesystem::path& err) {
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
    ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    pid_t process = 0;
    const int failure = ::posix_spawn(&process, argv.front(), &actions, nullptr, argv.data(), ::environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        throw std::runtime_error("cannot run " LAVALIGHT_BINARY);
    return process;
}

// Exit code of a process that has ended.
std::optional<int> exitCode(pid_t process) {
    int status = 0;
    if (::waitpid(process, &status, WNOHANG) != process)
        return std::nullopt;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

ProgramResult interruptLavalight(const std::vector<std::string>& arguments,
                                 const std::filesystem::path& folder) {
    std::vector<std::string> words = {LAVALIGHT_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const TemporaryFolder printed;
    const auto deadline = std::chrono::steady_clock::now() + kTimeAllowed;
    const pid_t process = start(words, folder, printed / "out", printed / "err");
    bool isInterrupted = false;
    for (;;) {
        if (const std::optional<int> code = exitCode(process))
            return {*code, readFile(printed / "out"), readFile(printed / "err")};
        if (!isInterrupted && catches(process, SIGINT)) {
            ::kill(process, SIGINT);
            isInterrupted = true;
        }
        if (std::chrono::steady_clock::now() > deadline)
            ::kill(process, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

} // namespace lavalight::test
