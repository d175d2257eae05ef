// Environment variables that the user may have set.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

// Variables that have other values while it lives: for a library that reads them meanwhile. Programs that are
// started later find the user's values.
class VariablesForNow {
  public:
    VariablesForNow() = default;
    ~VariablesForNow() {
        for (auto before = before_.rbegin(); before != before_.rend(); ++before)
            before->second ? ::setenv(before->first, before->second->c_str(), 1) : ::unsetenv(before->first);
    }
    VariablesForNow(const VariablesForNow&) = delete;
    VariablesForNow& operator=(const VariablesForNow&) = delete;

    // `name` must outlive this.
    void set(const char* name, const std::string& value) {
        const char* before = std::getenv(name);
        before_.emplace_back(name, before == nullptr ? std::nullopt : std::optional<std::string>(before));
        ::setenv(name, value.c_str(), 1);
    }

  private:
    std::vector<std::pair<const char*, std::optional<std::string>>> before_;
};

} // namespace lavalight
