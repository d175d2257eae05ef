// A file that the build put into the binary.
#pragma once

#include <span>
#include <string_view>

namespace lavalight {

struct EmbeddedFile {
    std::string_view name; // file name without folder
    std::string_view bytes;
};

} // namespace lavalight
