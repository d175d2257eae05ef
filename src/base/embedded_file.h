// A file that the build put into the binary.
#pragma once

#include <span>
#include <string_view>

namespace lavalight {

struct EmbeddedFile {
    std::string_view name; // path below the folder that the build says
    std::string_view bytes;
};

} // namespace lavalight
