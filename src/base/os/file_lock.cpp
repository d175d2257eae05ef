#include "base/os/file_lock.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;

// What the lock's holder has written into the file: the number of its process.
std::string contents(int descriptor) {
    std::array<char, 32> bytes{};
    const ssize_t count = ::pread(descriptor, bytes.data(), bytes.size(), 0);
    return {bytes.data(), count > 0 ? static_cast<size_t>(count) : 0};
}

// Whether the file still has its name; not if it was removed or replaced between opening and locking.
bool isStillThere(int descriptor, const fs::path& path) {
    struct stat opened {};
    struct stat named {};
    return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

} // namespace

FileLock::FileLock(const fs::path& file) : path_(lockFileOf(file)) {
    do {
        if (descriptor_ >= 0)
            ::close(descriptor_);
        descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0)
            throw Error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            const std::string holder = contents(descriptor_);
            ::close(descriptor_);
            throw Error(fmt::format("{} is in use by another process{}", file.string(),
                                    holder.empty() ? "" : " (" + holder + ")"));
        }
    } while (!isStillThere(descriptor_, path_));
    const std::string self = fmt::format("{}", ::getpid());
    if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, self.data(), self.size(), 0) < 0)
        return; // the number is for messages alone
}

// The file is removed before it is unlocked: whoever has opened it meanwhile finds it gone.
FileLock::~FileLock() {
    std::error_code ignored;
    fs::remove(path_, ignored);
    ::close(descriptor_);
}

fs::path lockFileOf(const fs::path& file) {
    fs::path path = file;
    path += ".lock";
    return path;
}

bool isLocked(const fs::path& file) {
    const int descriptor = ::open(lockFileOf(file).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return false;
    const bool isHeld = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(descriptor);
    return isHeld;
}

} // namespace lavalight
