// Starting programs beside a test.
#pragma once

#include <string>
#include <vector>

#include <spawn.h>
#include <sys/types.h>

namespace lavalight::test {

// The words as execve wants them, with a null pointer at the end. They must outlive it unchanged.
[[nodiscard]] std::vector<char*> argvOf(std::vector<std::string>& words);

// A program to be started, and what it gets that is not its parent's.
class Spawn {
  public:
    Spawn() { ::posix_spawn_file_actions_init(&actions_); }
    ~Spawn() { ::posix_spawn_file_actions_destroy(&actions_); }
    Spawn(const Spawn&) = delete;
    Spawn& operator=(const Spawn&) = delete;

    // Makes the stream this file, opened with these flags.
    void open(int stream, const std::string& file, int flags);
    // Makes the stream this descriptor of the parent's.
    void pass(int stream, int descriptor);
    void workIn(const std::string& folder);

    // Starts the program. The first word is a path, or found in PATH. Throws std::runtime_error where it
    // cannot be run.
    [[nodiscard]] pid_t start(std::vector<std::string> words) const;

  private:
    posix_spawn_file_actions_t actions_;
};

} // namespace lavalight::test
