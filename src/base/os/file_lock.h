// A file that only one process at a time may work at.
#pragma once

#include <filesystem>

namespace lavalight {

// While a lock lives, nobody else gets one for the same file. The system holds it on a file beside that one
// (.lock) and drops it where a process is killed. File systems that know no locks are trusted.
class FileLock {
  public:
    // Throws Error where another one has it, naming its process, or where the folder is not writable.
    explicit FileLock(const std::filesystem::path& file);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

// The file that a lock of `file` is held on.
[[nodiscard]] std::filesystem::path lockFileOf(const std::filesystem::path& file);

// Whether somebody holds the lock of `file`. Changes nothing.
[[nodiscard]] bool isLocked(const std::filesystem::path& file);

} // namespace lavalight
