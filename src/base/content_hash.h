// Hashes of large data: whether two programs had the same before them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lavalight {

// 128 bits by XXH3 (Yann Collet, xxHash), some 10 GB/s. It tells accidents, not forgeries.
class ContentHash {
  public:
    ContentHash();
    ~ContentHash();
    ContentHash(const ContentHash&) = delete;
    ContentHash& operator=(const ContentHash&) = delete;

    void add(std::span<const std::byte> bytes);
    // Adds the length too, so that what follows cannot be taken for a part of the text.
    void add(std::string_view text);
    // Adds the bytes of records, which must have no padding that nobody sets.
    template <typename T>
    void add(const std::vector<T>& records) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(std::string_view(reinterpret_cast<const char*>(records.data()), records.size() * sizeof(T)));
    }

    // Hash of all that was added so far, as 32 hexadecimal digits.
    [[nodiscard]] std::string text() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lavalight
