// Whole files in and out. Writing is atomic: a file is whole or absent.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lavalight {

// Throws Error unless `path` names a regular file: for readers that open the file themselves.
void requireRegularFile(const std::filesystem::path& path);

// The bytes of a regular file. Throws Error for a missing file, a directory, a device, an unreadable file,
// and for one that memory does not hold.
[[nodiscard]] std::string readFile(const std::filesystem::path& path);

// Calls `write` with the name of a new file in the same folder, brings that file to the disk (fsync), then
// renames it to `path`. If `write` or the renaming throws, nothing is left behind and an existing `path` is
// untouched. Only regular files are replaced: a rename over a device such as /dev/null would do lasting
// damage. Throws Error.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write);

// Writes `bytes` to `path`, as atomically.
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

// What processes left behind that were killed where they wrote `path`, or what they are writing still.
[[nodiscard]] std::vector<std::filesystem::path> unfinishedFiles(const std::filesystem::path& path);

// Removes these. No other process may be writing `path`.
void removeUnfinished(const std::filesystem::path& path);

// Throws Error unless a file can be created at `path`: asked before a long render rather than after it.
// Leaves nothing behind.
void requireWritable(const std::filesystem::path& path);

} // namespace lavalight
