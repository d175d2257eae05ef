// The files that a command reads, which none of its outputs may replace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace lavalight {

// Whether both names mean one file, through links and other spellings; files need not exist.
[[nodiscard]] bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

class InputFiles {
  public:
    // `role` goes on with "it is": "the scene". A file that does not exist cannot be replaced and is left
    // out.
    void add(const std::filesystem::path& file, const std::string& role);
    // Throws UsageError where `output`, or the file that it links to, is one of the inputs.
    void requireApart(const std::filesystem::path& output) const;

  private:
    using Identity = std::pair<uint64_t, uint64_t>; // device and inode
    std::map<Identity, std::string> roles_;
};

} // namespace lavalight
