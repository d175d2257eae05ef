// The checkpoint of a render under way: when to write it, and what if that fails.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/os/file_lock.h"
#include "film/film_file.h"

namespace lavalight {

class Checkpoint {
  public:
    // With an empty file name checkpoints are never due. Removes what killed renders left half-written.
    // Throws Error where the file cannot be written, or another process is writing it.
    Checkpoint(std::string file, std::chrono::duration<double> interval);

    [[nodiscard]] const std::string& file() const { return file_; }
    // The checkpoint that another process wrote before. Nothing where there is no such file; throws Error
    // where the file is no checkpoint, or damaged.
    [[nodiscard]] std::optional<FilmFile> read();

    [[nodiscard]] bool isWanted() const { return !file_.empty(); }
    // Whether the interval has passed since the last checkpoint was read or written.
    [[nodiscard]] bool isDue() const;
    // Writes the film that `record` makes, unless it has come no further than the one that was read. A
    // failure is told and remembered, not thrown: the render may yet come to its end, and the checkpoint from
    // before stays.
    void write(const std::function<FilmFile()>& record);
    // Throws Error if the last attempt failed.
    void requireWritten() const;

  private:
    std::string file_;
    std::unique_ptr<FileLock> lock_; // where there is a file
    std::chrono::duration<double> interval_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::optional<FilmProgress> read_; // how far the film that was read had come
    std::string failure_;              // message of the last attempt's failure; empty: it did not fail
};

} // namespace lavalight
