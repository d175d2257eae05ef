// Environment variables for the programs that a test starts.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace lavalight::test {

// A variable that is set while this lives, then as before. Tests of one process run one after the other, so
// nobody else looks.
class EnvironmentVariable {
  public:
    EnvironmentVariable(const std::string& name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name.c_str()))
            before_ = before;
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    ~EnvironmentVariable() {
        before_ ? ::setenv(name_.c_str(), before_->c_str(), 1) : ::unsetenv(name_.c_str());
    }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

  private:
    std::string name_;
    std::optional<std::string> before_;
};

} // namespace lavalight::test
