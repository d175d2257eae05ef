// Values one behind another in a string of bytes, for another process of this program.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"

namespace lavalight {

static_assert(std::endian::native == std::endian::little); // numbers stand as they do in memory

class ByteWriter {
  public:
    explicit ByteWriter(std::string_view mark) : bytes_(mark) {}

    void number(uint64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value)); }
    void text(std::string_view text) {
        number(text.size());
        bytes_ += text;
    }
    template <typename T>
    void array(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        text({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
    }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

// Reads back what a ByteWriter wrote. Throws Error where bytes are missing: they may come from anywhere.
class ByteReader {
  public:
    // The mark of what the bytes are must be there.
    ByteReader(std::string_view bytes, std::string_view mark) : rest_(bytes) {
        if (!rest_.starts_with(mark))
            throw Error("it does not begin as such bytes do");
        rest_.remove_prefix(mark.size());
    }

    uint64_t number() {
        uint64_t value = 0;
        std::memcpy(&value, take(sizeof(value)).data(), sizeof(value));
        return value;
    }
    std::string text() { return std::string(take(number())); }
    template <typename T>
    std::vector<T> array() {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::string_view bytes = take(number());
        if (bytes.size() % sizeof(T) != 0)
            throw Error("an array in it ends within a value");
        std::vector<T> values(bytes.size() / sizeof(T));
        if (!values.empty())
            std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    // Throws Error where more follows.
    void requireEnd() const {
        if (!rest_.empty())
            throw Error("more follows than belongs to it");
    }

  private:
    std::string_view take(uint64_t count) {
        if (count > rest_.size())
            throw Error("it ends too early");
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }

    std::string_view rest_;
};

} // namespace lavalight
