// Small results that are slow to make, kept from one run to the next in the user's cache folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace lavalight {

// A cache may be empty at any time, and several processes may use one. Nothing is reported that goes wrong
// with it: the results are made again.
class UserCache {
  public:
    // Without a folder, nothing is kept. Files that were not used for longest go where there are more than
    // `mostBytes`.
    UserCache(std::optional<std::filesystem::path> folder, uint64_t mostBytes)
        : folder_(std::move(folder)), mostBytes_(mostBytes) {}

    // What was kept under that key, which names a file; none where it is not there, or was damaged.
    [[nodiscard]] std::optional<std::string> find(const std::string& key) const;
    void keep(const std::string& key, std::string_view bytes) const;

  private:
    void removeOldest() const;

    std::optional<std::filesystem::path> folder_;
    uint64_t mostBytes_;
};

// The folder of that name that the variable LAVALIGHT_CACHE says, or else XDG_CACHE_HOME or HOME. None where
// LAVALIGHT_CACHE is "off", or no variable is set.
[[nodiscard]] std::optional<std::filesystem::path> userCacheFolder(const std::string& name);

} // namespace lavalight
