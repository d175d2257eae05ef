// The version of the program, as `--version` says it.
#pragma once

#include <string_view>

namespace lavalight {

inline constexpr std::string_view kVersion = "0.1.0";

} // namespace lavalight
