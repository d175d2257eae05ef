#include "cli/options/option_values.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace lavalight {

std::vector<std::string_view> splitAt(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    size_t start = 0;
    for (size_t at = text.find(separator); at != std::string_view::npos; at = text.find(separator, start)) {
        parts.push_back(text.substr(start, at - start));
        start = at + 1;
    }
    parts.push_back(text.substr(start));
    return parts;
}

std::optional<uint32_t> parseHexColor(std::string_view text) {
    const auto isDigit = [](unsigned char c) { return std::isxdigit(c) != 0; };
    if (text.size() != 7 || text[0] != '#' || !std::all_of(text.begin() + 1, text.end(), isDigit))
        return std::nullopt;
    return static_cast<uint32_t>(std::stoul(std::string(text.substr(1)), nullptr, 16));
}

} // namespace lavalight
