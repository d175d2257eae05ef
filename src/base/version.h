// The version of the program and the commit that it was built from. cmake/version.cmake writes their values
// at build time.
#pragma once

#include <string>
#include <string_view>

namespace lavalight {

// The version of project() in CMakeLists.txt.
extern const std::string_view kVersion;

// The first digits of the commit's hash, and "-dirty" where the sources differ from it; empty where git does
// not know.
extern const std::string_view kCommit;

// Version and commit as `--version` says them: "0.1.0 (eae6697c1b2f)".
[[nodiscard]] std::string versionText();

} // namespace lavalight
