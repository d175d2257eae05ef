// The bytes of a fuzzer's input, taken as values.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <nlohmann/json.hpp>

namespace lavalight::test {

// Ends the fuzzer with a finding unless the condition holds.
inline void require(bool condition) {
    if (!condition)
        std::abort();
}

// What is left of an input. An input that has ended gives zeros.
class Input {
  public:
    explicit Input(std::string_view bytes) : rest_(bytes) {}

    std::string_view take(size_t most) {
        const std::string_view taken = rest_.substr(0, most);
        rest_.remove_prefix(taken.size());
        return taken;
    }

    std::string_view takeLine() {
        const std::string_view line = take(rest_.find('\n'));
        take(1);
        return line;
    }

    template <class Number>
    Number number() {
        Number value{};
        const std::string_view bytes = take(sizeof(value));
        std::memcpy(&value, bytes.data(), bytes.size());
        return value;
    }

    // A finite number of single precision.
    double finite() {
        const auto value = number<float>();
        return std::isfinite(value) ? value : 0.5;
    }

    template <class Values>
    const auto& oneOf(const Values& values) {
        return values[number<uint8_t>() % std::size(values)];
    }

    [[nodiscard]] std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
};

inline nlohmann::json numbers(Input& input, size_t count) {
    nlohmann::json list = nlohmann::json::array();
    for (size_t i = 0; i < count; ++i)
        list.push_back(input.finite());
    return list;
}

} // namespace lavalight::test
