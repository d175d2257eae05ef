// Finds what a user asks for by name or number.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lavalight {

// What is asked for, in the words of a message: "OPTION: OWNER has no KIND "wanted"; it has 0 "a", 1 "b"".
struct Wanted {
    std::string text;        // a name, or a number counted from 0
    std::string_view option; // "--camera"
    std::string_view kind;   // "camera"
    std::string_view owner;  // the scene
};

// The first of `names` that is the text; else the one of that number. Throws UsageError, naming those that
// there are.
[[nodiscard]] size_t findNamed(const std::vector<std::string>& names, const Wanted& wanted);

// The text by which findNamed() finds names[index]: its name, or its number where it has none or another one
// of that name comes first. Where a number is also a name of another, nothing finds it.
[[nodiscard]] std::string textFor(const std::vector<std::string>& names, size_t index);

} // namespace lavalight
