#include "session/frame_sequence.h"

#include <filesystem>

#include <fmt/format.h>

namespace lavalight {

std::string numberedFile(const std::string& file, uint32_t frame) {
    if (file.empty())
        return file;
    const std::filesystem::path path(file);
    const std::string name =
        fmt::format("{}_{:04}{}", path.stem().string(), frame, path.extension().string());
    return (path.parent_path() / name).string();
}

} // namespace lavalight
