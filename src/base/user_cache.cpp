#include "base/user_cache.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>

#include "base/content_hash.h"
#include "base/os/environment.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;

constexpr size_t kHashLength = 32; // ContentHash::text(), before the bytes

std::string hashOf(std::string_view bytes) {
    ContentHash hash;
    hash.add(bytes);
    return hash.text();
}

// A name that no other process and no other thread writes to.
fs::path partOf(const fs::path& file) {
    static std::atomic<uint32_t> number = 0;
    return fs::path(file) += fmt::format(".{}-{}.part", getpid(), ++number);
}

} // namespace

std::optional<std::string> UserCache::find(const std::string& key) const {
    if (!folder_)
        return std::nullopt;
    const fs::path file = *folder_ / key;
    std::ifstream in(file, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (content.size() < kHashLength ||
        content.substr(0, kHashLength) != hashOf(std::string_view(content).substr(kHashLength)))
        return std::nullopt;
    std::error_code code;
    fs::last_write_time(file, fs::file_time_type::clock::now(), code); // it was used
    return content.substr(kHashLength);
}

void UserCache::keep(const std::string& key, std::string_view bytes) const {
    if (!folder_)
        return;
    const fs::path file = *folder_ / key;
    const fs::path part = partOf(file);
    std::error_code code;
    fs::create_directories(*folder_, code);
    std::ofstream out(part, std::ios::binary);
    out << hashOf(bytes) << bytes;
    out.close();
    if (out)
        fs::rename(part, file, code);
    if (!out || code)
        fs::remove(part, code);
    if (key.ends_with('0')) // now and then: it looks at every file
        removeOldest();
}

void UserCache::removeOldest() const {
    struct Kept {
        fs::file_time_type used;
        uint64_t bytes;
        fs::path file;
    };
    std::vector<Kept> all;
    uint64_t bytes = 0;
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(*folder_, code)) {
        std::error_code gone; // another process may remove it meanwhile
        const Kept kept{entry.last_write_time(gone), entry.file_size(gone), entry.path()};
        if (gone)
            continue;
        bytes += kept.bytes;
        all.push_back(kept);
    }
    std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
    for (const Kept& kept : all) {
        if (bytes <= mostBytes_)
            return;
        fs::remove(kept.file, code);
        bytes -= kept.bytes;
    }
}

std::optional<fs::path> userCacheFolder(const std::string& name) {
    if (const auto named = environmentPath("LAVALIGHT_CACHE"))
        return *named == "off" ? std::nullopt : std::optional(*named / name);
    if (const auto cache = environmentPath("XDG_CACHE_HOME"))
        return *cache / "lavalight" / name;
    const auto home = environmentPath("HOME");
    return home ? std::optional(*home / ".cache/lavalight" / name) : std::nullopt;
}

} // namespace lavalight
