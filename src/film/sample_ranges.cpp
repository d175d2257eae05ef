#include "film/sample_ranges.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/parse.h"

namespace lavalight {
namespace {

constexpr uint32_t kMostSamples = 0x7fffffff;

// Takes "A:B" off the front of `text`.
std::optional<SampleRange> takeRange(std::string_view& text) {
    std::string_view rest = text;
    const auto first = takeNumber<uint32_t>(rest);
    if (!first || !rest.starts_with(':'))
        return std::nullopt;
    rest.remove_prefix(1);
    const auto end = takeNumber<uint32_t>(rest);
    if (!end || *first >= *end || *end > kMostSamples)
        return std::nullopt;
    text = rest;
    return SampleRange{*first, *end};
}

} // namespace

std::string textOf(const SampleRanges& ranges) {
    std::string text;
    for (const SampleRange& range : ranges)
        text += fmt::format("{}{}:{}", text.empty() ? "" : ",", range.first, range.end);
    return text;
}

std::optional<SampleRanges> parseSampleRanges(std::string_view text) {
    SampleRanges ranges;
    for (;;) {
        const std::optional<SampleRange> range = takeRange(text);
        if (!range || (!ranges.empty() && range->first <= ranges.back().end))
            return std::nullopt;
        ranges.push_back(*range);
        if (text.empty())
            return ranges;
        if (text.front() != ',')
            return std::nullopt;
        text.remove_prefix(1);
    }
}

uint32_t countOf(const SampleRanges& ranges) {
    uint32_t count = 0;
    for (const SampleRange& range : ranges)
        count += range.end - range.first;
    return count;
}

std::optional<SampleRange> overlapOf(const SampleRanges& a, const SampleRanges& b) {
    for (const SampleRange& x : a)
        for (const SampleRange& y : b) {
            const SampleRange both{std::max(x.first, y.first), std::min(x.end, y.end)};
            if (both.first < both.end)
                return both;
        }
    return std::nullopt;
}

SampleRanges unionOf(const SampleRanges& a, const SampleRanges& b) {
    SampleRanges all = a;
    all.insert(all.end(), b.begin(), b.end());
    std::sort(all.begin(), all.end(),
              [](const SampleRange& x, const SampleRange& y) { return x.first < y.first; });
    SampleRanges joined;
    for (const SampleRange& range : all) {
        if (!joined.empty() && joined.back().end == range.first)
            joined.back().end = range.end;
        else
            joined.push_back(range);
    }
    return joined;
}

} // namespace lavalight
