// Values of options, as the command line has them, for messages and records.
#pragma once

#include <string>

#include <fmt/format.h>
#include <glm/glm.hpp>

namespace lavalight {

// "1,0.5,0"
template <typename Number>
[[nodiscard]] std::string commaText(const glm::vec<3, Number>& v) {
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}

// Throws UsageError, naming the option and the range, for a value outside it, and for NaN.
void requireRange(const char* option, double value, double least, double most);

} // namespace lavalight
