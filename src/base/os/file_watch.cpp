#include "base/os/file_watch.h"

#include <algorithm>
#include <array>
#include <thread>

#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "base/error.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr milliseconds kPollingInterval{100};
constexpr milliseconds kQuiet{20}; // an editor's save is over when nothing follows for so long

constexpr uint32_t kSaves =
    IN_CLOSE_WRITE | IN_MODIFY | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_ATTRIB;

} // namespace

FileWatch::FileWatch(fs::path folder, Means means) : folder_(std::move(folder)) {
    if (!fs::is_directory(folder_))
        throw Error(fmt::format("cannot watch {}: it is not a directory", folder_.string()));
    if (means == Means::automatic)
        notices_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    watchFolders();
    last_ = take();
}

FileWatch::~FileWatch() {
    if (notices_ >= 0)
        close(notices_);
}

// inotify watches single folders: each one below ours is added. Adding a known one again changes nothing.
void FileWatch::watchFolders() {
    if (notices_ < 0)
        return;
    bool granted = inotify_add_watch(notices_, folder_.c_str(), kSaves) >= 0;
    std::error_code ignored; // folders may vanish meanwhile
    for (const auto& entry : fs::recursive_directory_iterator(folder_, ignored))
        if (entry.is_directory(ignored))
            granted = inotify_add_watch(notices_, entry.path().c_str(), kSaves) >= 0 && granted;
    if (!granted) {
        close(notices_);
        notices_ = -1;
    }
}

FileWatch::Snapshot FileWatch::take() const {
    Snapshot snapshot;
    std::error_code ignored; // files may vanish meanwhile
    for (const auto& entry : fs::recursive_directory_iterator(folder_, ignored)) {
        if (!entry.is_regular_file(ignored))
            continue;
        const Stamp stamp{entry.last_write_time(ignored), entry.file_size(ignored)};
        snapshot.emplace(entry.path().lexically_relative(folder_).generic_string(), stamp);
    }
    return snapshot;
}

// Whether there is something to tell.
bool FileWatch::sleepUntilNotice(milliseconds atMost) {
    if (notices_ < 0) {
        std::this_thread::sleep_for(std::min(atMost, kPollingInterval));
        return true;
    }
    pollfd question{notices_, POLLIN, 0};
    bool noticed = false;
    while (poll(&question, 1, static_cast<int>((noticed ? kQuiet : atMost).count())) > 0) {
        std::array<char, 4096> buffer;
        while (read(notices_, buffer.data(), buffer.size()) > 0) {
        }
        noticed = true;
    }
    return noticed;
}

std::vector<std::string> FileWatch::wait(milliseconds atMost) {
    const auto end = std::chrono::steady_clock::now() + atMost;
    std::vector<std::string> changes;
    do {
        const auto left = std::chrono::duration_cast<milliseconds>(end - std::chrono::steady_clock::now());
        if (!sleepUntilNotice(std::max(left, milliseconds(0))))
            break;
        watchFolders();
        Snapshot now = take();
        for (const auto& [path, stamp] : now)
            if (const auto before = last_.find(path); before == last_.end() || before->second != stamp)
                changes.push_back(path);
        for (const auto& [path, stamp] : last_)
            if (!now.contains(path))
                changes.push_back(path);
        last_ = std::move(now);
    } while (changes.empty() && std::chrono::steady_clock::now() < end);
    std::sort(changes.begin(), changes.end());
    return changes;
}

} // namespace lavalight
