// The options of a command line as words again, to be given to another.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace lavalight {

// The options that the user gave, in the order of --help, with their values as they were written; without
// those of `except`, which are names without dashes.
[[nodiscard]] std::vector<std::string> wordsGiven(const CLI::App& parser,
                                                  const std::set<std::string>& except);

} // namespace lavalight
