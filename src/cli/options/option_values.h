// Numbers in the texts of options.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace lavalight {

// The whole of `text` as a number, or nothing.
template <typename Number>
[[nodiscard]] std::optional<Number> parseNumber(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

[[nodiscard]] std::vector<std::string_view> splitAt(std::string_view text, char separator);

// The vector that "X,Y,Z" stands for, all finite, or nothing.
[[nodiscard]] std::optional<glm::vec3> parseVector(std::string_view text);

} // namespace lavalight
