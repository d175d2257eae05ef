// Which samples an image holds: what --samples A:B asks for, and what merge joins.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lavalight {

// Samples from `first` to before `end` of every pixel.
struct SampleRange {
    uint32_t first = 0;
    uint32_t end = 0;
    bool operator==(const SampleRange&) const = default;
};

// Ranges in ascending order, apart from each other, none empty.
using SampleRanges = std::vector<SampleRange>;

// Ranges as text and back: "0:16,32:64".
[[nodiscard]] std::string textOf(const SampleRanges& ranges);
[[nodiscard]] std::optional<SampleRanges> parseSampleRanges(std::string_view text);

[[nodiscard]] uint32_t countOf(const SampleRanges& ranges);

// A range of samples that both hold.
[[nodiscard]] std::optional<SampleRange> overlapOf(const SampleRanges& a, const SampleRanges& b);
// The ranges of both, which must not overlap; neighbours become one.
[[nodiscard]] SampleRanges unionOf(const SampleRanges& a, const SampleRanges& b);

} // namespace lavalight
