// Numbers in texts.
#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

namespace lavalight {

// Takes a number off the front of `text`. Nothing, and `text` as it was, where none that fits stands there.
template <typename Number>
[[nodiscard]] std::optional<Number> takeNumber(std::string_view& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc())
        return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

// The whole of `text` as a number, or nothing.
template <typename Number>
[[nodiscard]] std::optional<Number> parseNumber(std::string_view text) {
    const std::optional<Number> value = takeNumber<Number>(text);
    return text.empty() ? value : std::nullopt;
}

} // namespace lavalight
