#include "support/run_program.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/spawn.h"

namespace lavalight::test {
namespace {

constexpr unsigned kSecondsAllowed = 120; // sanitizers on two busy cores included
constexpr int kCannotStart = 127;         // as in a shell

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// An unnamed file: what the program prints must not show up in the folder that a test looks at.
File unnamedFile() {
    File file(std::tmpfile());
    if (!file)
        throw std::runtime_error(std::string("cannot make a temporary file: ") + std::strerror(errno));
    return file;
}

std::string contents(std::FILE* file) {
    std::string text;
    std::array<char, 4096> chunk{};
    std::rewind(file);
    for (size_t n = 0; (n = std::fread(chunk.data(), 1, chunk.size(), file)) > 0;)
        text.append(chunk.data(), n);
    return text;
}

// Becomes the program, by nothing but calls that are safe between fork and exec.
[[noreturn]] void becomeProgram(char* const* argv, const char* folder, int out, int err) {
    const int nothing = ::open("/dev/null", O_RDONLY);
    if (::dup2(nothing, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 &&
        ::dup2(err, STDERR_FILENO) >= 0 && ::chdir(folder) == 0) {
        ::alarm(kSecondsAllowed); // outlives exec
        ::execv(argv[0], argv);
    }
    ::_exit(kCannotStart);
}

} // namespace

ProgramResult runLavalight(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    std::vector<std::string> words = {LAVALIGHT_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::vector<char*> argv = argvOf(words);
    const File out = unnamedFile();
    const File err = unnamedFile();

    const pid_t child = ::fork();
    if (child < 0)
        throw std::runtime_error(std::string("cannot fork: ") + std::strerror(errno));
    if (child == 0)
        becomeProgram(argv.data(), folder.c_str(), ::fileno(out.get()), ::fileno(err.get()));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const int exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (exitCode == kCannotStart)
        throw std::runtime_error("cannot run " LAVALIGHT_BINARY);
    return {exitCode, contents(out.get()), contents(err.get())};
}

} // namespace lavalight::test
