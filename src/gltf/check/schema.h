// Checks that the JSON of a glTF file has the types and references that the import relies on.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace lavalight {

// Parses and checks `text`: nesting depth, the types of all properties that Lavalight reads, and every index
// against the array that it points into. Numbers come out in the form that the readers expect: integers as
// integers (3.0 becomes 3), other numbers as floating point. Throws Error naming `source`, the object, the
// property and the figures.
[[nodiscard]] nlohmann::json parseCheckedJson(std::string_view text, const std::string& source);

} // namespace lavalight
