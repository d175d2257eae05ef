// The whole program but for what only a process of its own needs.
#pragma once

namespace lavalight {

// Runs a command line, `argv[0]` being the program, and returns its exit code: failures become one line on
// stderr.
[[nodiscard]] int runCommandLine(int argc, char** argv);

} // namespace lavalight
