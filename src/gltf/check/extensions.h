// Which glTF extensions are read.
#pragma once

#include <string_view>

namespace lavalight {

// By the exact name. Among them are those that only carry descriptions, which have no effect on a picture.
[[nodiscard]] bool isSupportedExtension(std::string_view name);

} // namespace lavalight
