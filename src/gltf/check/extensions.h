// Which glTF extensions are read.
#pragma once

#include <string_view>

namespace lavalight {

// Whether the extension of that exact name is read. Some only carry descriptions, which no picture shows.
[[nodiscard]] bool isSupportedExtension(std::string_view name);

} // namespace lavalight
