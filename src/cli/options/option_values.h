// Lists of numbers, and colours, in the texts of options.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "base/parse.h"

namespace lavalight {

[[nodiscard]] std::vector<std::string_view> splitAt(std::string_view text, char separator);

// 0xrrggbb of "#rrggbb", or nothing.
[[nodiscard]] std::optional<uint32_t> parseHexColor(std::string_view text);

// The vector that "X,Y,Z" or so many numbers stand for, all finite in single precision, or nothing.
template <typename Number, glm::length_t Length = 3>
[[nodiscard]] std::optional<glm::vec<Length, Number>> parseVector(std::string_view text) {
    const auto parts = splitAt(text, ',');
    if (parts.size() != Length)
        return std::nullopt;
    glm::vec<Length, Number> vector(0);
    for (size_t i = 0; i < Length; ++i) {
        const auto value = parseNumber<Number>(parts[i]);
        if (!value || !std::isfinite(static_cast<float>(*value)))
            return std::nullopt;
        vector[static_cast<glm::length_t>(i)] = *value;
    }
    return vector;
}

} // namespace lavalight
