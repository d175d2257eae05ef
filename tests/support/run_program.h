// Runs the lavalight binary as a user would, for tests of the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lavalight::test {

struct ProgramResult {
    int exitCode = -1; // 128 + the signal's number if a signal ended it, as in a shell
    std::string out;   // all of stdout
    std::string err;   // all of stderr
};

// Runs the binary that the macro LAVALIGHT_BINARY names, without a shell, with `folder` as working folder and
// an empty stdin. A program that takes longer than two minutes is killed (exit code 142, SIGALRM). Throws
// std::runtime_error if it cannot be started.
[[nodiscard]] ProgramResult runLavalight(const std::vector<std::string>& arguments,
                                         const std::filesystem::path& folder);

} // namespace lavalight::test
