// Bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace lavalight {

// RFC 4648, section 4, padded, without line breaks.
[[nodiscard]] std::string encodeBase64(std::string_view bytes);

} // namespace lavalight
