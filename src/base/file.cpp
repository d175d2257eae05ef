#include "base/file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/os/machine.h"
#include "base/os/memory.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throwUnreadable(const fs::path& path, const std::string& reason) {
    throw Error(fmt::format("cannot read {}: {}", path.string(), reason));
}

[[noreturn]] void throwUnwritable(const fs::path& path, const std::string& reason) {
    throw Error(fmt::format("cannot write {}: {}", path.string(), reason));
}

constexpr std::string_view kUnfinished = ".part";

// A name that is unique in this process, among processes and among machines: several renders may write into
// one folder.
fs::path temporaryName(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    fs::path name = path;
    name += fmt::format(".{}-{}-{}{}", hostName(), ::getpid(), counter++, kUnfinished);
    return name;
}

// Removes the unfinished file unless it was renamed to its final name.
class TemporaryFile {
  public:
    explicit TemporaryFile(const fs::path& target) : path_(temporaryName(target)) {}
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

// A file descriptor, closed in the end.
class Descriptor {
  public:
    Descriptor(const fs::path& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC)) {}
    ~Descriptor() {
        if (number_ >= 0)
            ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] bool isOpen() const { return number_ >= 0; }
    [[nodiscard]] bool sync() const { return ::fsync(number_) == 0; }

  private:
    int number_;
};

// Brings a file to the disk; else a power cut soon after the renaming may leave an empty one under the final
// name.
void syncContents(const fs::path& part, const fs::path& path) {
    const Descriptor file(part, O_RDONLY);
    if (!file.isOpen() || !file.sync())
        throwUnwritable(path, std::strerror(errno));
}

// Brings the renaming to the disk. Some file systems cannot; then it is as durable as they make it.
void syncFolder(const fs::path& path) {
    const fs::path folder = path.parent_path();
    const Descriptor descriptor(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
    if (descriptor.isOpen())
        (void)descriptor.sync();
}

void requireReplaceable(const fs::path& path) {
    if (!path.has_filename())
        throwUnwritable(path, "no file name given");
    std::error_code code;
    const auto status = fs::status(path, code);
    if (fs::is_directory(status))
        throwUnwritable(path, "it is a directory");
    if (fs::exists(status) && !fs::is_regular_file(status))
        throwUnwritable(path, "not a regular file");
    const fs::path folder = path.parent_path();
    if (!folder.empty() && fs::status(folder, code).type() == fs::file_type::not_found)
        throwUnwritable(path, fmt::format("the directory {} does not exist", folder.string()));
}

} // namespace

void requireRegularFile(const fs::path& path) {
    if (path.empty())
        throwUnreadable("\"\"", "no file name given");
    std::error_code code;
    const auto status = fs::status(path, code);
    if (status.type() == fs::file_type::not_found)
        throwUnreadable(path, "no such file");
    if (!fs::status_known(status))
        throwUnreadable(path, code.message());
    if (fs::is_directory(status))
        throwUnreadable(path, "it is a directory");
    if (!fs::is_regular_file(status))
        throwUnreadable(path, "not a regular file");
}

std::string readFile(const fs::path& path) {
    requireRegularFile(path);
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throwUnreadable(path, std::strerror(errno));
    std::error_code code;
    const auto size = fs::file_size(path, code);
    if (code)
        throwUnreadable(path, code.message());
    if (const std::string shortage = memoryShortage(size); !shortage.empty())
        throwUnreadable(path, "its bytes " + shortage);
    std::string bytes(size, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<size_t>(in.gcount()) != bytes.size())
        throwUnreadable(path, "the file ended early");
    return bytes;
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    requireReplaceable(path);
    const TemporaryFile part(path);
    write(part.path());
    syncContents(part.path(), path);
    std::error_code code;
    fs::rename(part.path(), path, code);
    if (code)
        throwUnwritable(path, code.message());
    syncFolder(path);
}

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
    writeFileAtomically(path, [&](const fs::path& part) {
        std::ofstream out(part, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out)
            throwUnwritable(path, std::strerror(errno));
    });
}

std::vector<fs::path> unfinishedFiles(const fs::path& path) {
    const fs::path folder = path.parent_path();
    const std::string prefix = path.filename().string() + ".";
    std::vector<fs::path> unfinished;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(prefix) && name.ends_with(kUnfinished) &&
            name.size() > prefix.size() + kUnfinished.size())
            unfinished.push_back(entry.path());
    }
    return unfinished;
}

void removeUnfinished(const fs::path& path) {
    std::error_code ignored;
    for (const fs::path& file : unfinishedFiles(path))
        fs::remove(file, ignored);
}

void requireWritable(const fs::path& path) {
    requireReplaceable(path);
    const TemporaryFile part(path);
    if (!std::ofstream(part.path(), std::ios::binary))
        throwUnwritable(path, std::strerror(errno));
}

} // namespace lavalight
