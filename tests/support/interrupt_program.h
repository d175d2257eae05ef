// Runs the lavalight binary and interrupts it once it is rendering.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace lavalight::test {

// Sends SIGINT as soon as the program catches it, which it does while it renders, and waits for the end. The
// program is killed after two minutes. Throws std::runtime_error if it cannot be started.
[[nodiscard]] ProgramResult interruptLavalight(const std::vector<std::string>& arguments,
                                               const std::filesystem::path& folder);

} // namespace lavalight::test
