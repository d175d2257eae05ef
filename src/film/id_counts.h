// Which ids the samples of each pixel had, and how often: a mean of ids means nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace lavalight {

struct IdCount {
    uint32_t id = 0;
    uint32_t count = 0;
    bool operator==(const IdCount&) const = default;
};

// What a sample has that met nothing; other ids begin with 1.
inline constexpr uint32_t kNoId = 0;

class IdCounts {
  public:
    explicit IdCounts(size_t pixels = 0) : first_(pixels) {}

    [[nodiscard]] size_t pixels() const { return first_.size(); }
    void add(size_t pixel, uint32_t id, uint32_t count = 1);
    // The counts of a pixel, the largest first, of equal ones the lowest id.
    [[nodiscard]] std::vector<IdCount> ranked(size_t pixel) const;
    // The most ids that a pixel has.
    [[nodiscard]] size_t deepest() const;

  private:
    std::vector<IdCount> first_;                               // nearly all pixels have one id
    std::unordered_map<size_t, std::vector<IdCount>> further_; // by pixel
};

} // namespace lavalight
