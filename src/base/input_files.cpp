#include "base/input_files.h"

#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>

#include "base/error.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;

// Device and inode, links followed; nothing where there is no such file.
std::optional<std::pair<uint64_t, uint64_t>> identityOf(const fs::path& file) {
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0)
        return std::nullopt;
    return std::pair<uint64_t, uint64_t>(found.st_dev, found.st_ino);
}

fs::path canonicalOf(const fs::path& file) {
    std::error_code code;
    const fs::path path = fs::weakly_canonical(fs::absolute(file, code), code);
    return code ? file : path;
}

} // namespace

bool isSameFile(const fs::path& a, const fs::path& b) {
    const auto identityA = identityOf(a);
    const auto identityB = identityOf(b);
    if (identityA || identityB)
        return identityA == identityB;
    return canonicalOf(a) == canonicalOf(b);
}

void InputFiles::add(const fs::path& file, const std::string& role) {
    if (const auto identity = identityOf(file))
        roles_.emplace(*identity, role);
}

void InputFiles::requireApart(const fs::path& output) const {
    const auto identity = identityOf(output);
    const auto found = identity ? roles_.find(*identity) : roles_.end();
    if (found != roles_.end())
        throw UsageError(fmt::format("cannot write {}: it is {}; give the output another name",
                                     output.string(), found->second));
}

} // namespace lavalight
