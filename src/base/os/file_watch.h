// Notices what is saved below a folder.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lavalight {

class FileWatch {
  public:
    enum class Means {
        automatic, // the kernel's notices, or, where it grants none, polling
        polling    // asking for all files' times over and over
    };

    // Throws Error where there is no such folder.
    explicit FileWatch(std::filesystem::path folder, Means means = Means::automatic);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    // Waits until something is written, made, renamed or removed, or the time is over; returns early on a
    // signal. Paths below the folder of the files that differ since the last call, ascending; a series of
    // saves in quick succession counts as one.
    [[nodiscard]] std::vector<std::string> wait(std::chrono::milliseconds atMost);

  private:
    struct Stamp {
        std::filesystem::file_time_type time;
        uint64_t bytes = 0;
        bool operator==(const Stamp&) const = default;
    };
    using Snapshot = std::map<std::string, Stamp>;

    [[nodiscard]] Snapshot take() const;
    [[nodiscard]] bool sleepUntilNotice(std::chrono::milliseconds atMost);
    void watchFolders();

    std::filesystem::path folder_;
    int notices_ = -1; // inotify's descriptor; -1: polling
    Snapshot last_;
};

} // namespace lavalight
