// Environment variables that the user may have set.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace lavalight {

// None where the variable is not set, or empty, which means the same to whoever sets one.
[[nodiscard]] inline std::optional<std::string> environmentVariable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0' ? std::optional<std::string>(value) : std::nullopt;
}

// A variable that names a file or folder.
[[nodiscard]] inline std::optional<std::filesystem::path> environmentPath(const char* name) {
    return environmentVariable(name);
}

} // namespace lavalight
