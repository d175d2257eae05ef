#include "cli/options/option_values.h"

#include <cmath>

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

std::optional<glm::vec3> parseVector(std::string_view text) {
    const auto parts = splitAt(text, ',');
    if (parts.size() != 3)
        return std::nullopt;
    glm::vec3 vector(0.0f);
    for (size_t i = 0; i < 3; ++i) {
        const auto value = parseNumber<float>(parts[i]);
        if (!value || !std::isfinite(*value))
            return std::nullopt;
        vector[static_cast<glm::length_t>(i)] = *value;
    }
    return vector;
}

} // namespace lavalight
