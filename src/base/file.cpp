#include "base/file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"

namespace lavalight {
namespace {

// Unique in this process and among processes: several renders may write into one folder.
std::filesystem::path temporaryName(const std::filesystem::path& path) {
    static std::atomic<unsigned> counter{0};
    std::filesystem::path name = path;
    name += fmt::format(".{}-{}.part", ::getpid(), counter++);
    return name;
}

void removeQuietly(const std::filesystem::path& path) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

} // namespace

std::string readFile(const std::filesystem::path& path) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status))
        throw Error(fmt::format("cannot read {}: no such file", path.string()));
    if (std::filesystem::is_directory(status))
        throw Error(fmt::format("cannot read {}: it is a directory", path.string()));
    if (!std::filesystem::is_regular_file(status))
        throw Error(fmt::format("cannot read {}: not a regular file", path.string()));
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw Error(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
    std::string bytes(std::filesystem::file_size(path), '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<size_t>(in.gcount()) != bytes.size())
        throw Error(fmt::format("cannot read {}: the file ended early", path.string()));
    return bytes;
}

void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write) {
    const std::filesystem::path part = temporaryName(path);
    try {
        write(part);
        std::filesystem::rename(part, path);
    } catch (const std::filesystem::filesystem_error& error) {
        removeQuietly(part);
        throw Error(fmt::format("cannot write {}: {}", path.string(), error.code().message()));
    } catch (...) {
        removeQuietly(part);
        throw;
    }
}

void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
    writeFileAtomically(path, [&](const std::filesystem::path& part) {
        std::ofstream out(part, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out)
            throw Error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
    });
}

void requireWritable(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path))
        throw Error(fmt::format("cannot write {}: it is a directory", path.string()));
    const std::filesystem::path part = temporaryName(path);
    std::ofstream probe(part, std::ios::binary);
    if (!probe)
        throw Error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
    probe.close();
    removeQuietly(part);
}

} // namespace lavalight
