// Lists of numbers in the texts of options.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "base/parse.h"

namespace lavalight {

[[nodiscard]] std::vector<std::string_view> splitAt(std::string_view text, char separator);

// The vector that "X,Y,Z" stands for, all finite, or nothing.
[[nodiscard]] std::optional<glm::vec3> parseVector(std::string_view text);

} // namespace lavalight
