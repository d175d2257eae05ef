// Failures of the world (file, scene, device, shader), as opposed to bugs, which are asserts.
#pragma once

#include <stdexcept>
#include <string>

namespace lavalight {

// Thrown with a message that names the operation, the object and, where there is one, the remedy. Caught
// once, in main: one line on stderr, exit 1.
class Error : public std::runtime_error {
  public:
    explicit Error(const std::string& message) : std::runtime_error(message) {}
};

// The user asked for something that cannot be meant: exit 2.
class UsageError : public Error {
  public:
    explicit UsageError(const std::string& message) : Error(message) {}
};

} // namespace lavalight
