// The options of a command line as words again, to be given to another.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace lavalight {

// Options that the user gave, in the order of --help, as --name=VALUE, since a value may begin with a dash;
// `except` holds names, without dashes, to leave out. Options of several values lose all but the first.
[[nodiscard]] std::vector<std::string> wordsGiven(const CLI::App& parser,
                                                  const std::set<std::string>& except);

} // namespace lavalight
