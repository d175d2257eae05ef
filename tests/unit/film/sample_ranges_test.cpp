// Ranges of samples: their words, and what two of them have in common.
#include <gtest/gtest.h>

#include "film/sample_ranges.h"

namespace lavalight {
namespace {

TEST(SampleRanges, WordsComeBack) {
    for (const char* text : {"0:1", "3:64", "0:16,32:64,100:2147483647"})
        EXPECT_EQ(textOf(parseSampleRanges(text).value()), text);
}

TEST(SampleRanges, WhatIsNoRangeIsNothing) {
    for (const char* text : {"", "1", ":", "1:", ":1", "1:1", "2:1", "-1:1", "0:1,", ",0:1", "0:1,1:2",
                             "0:4,2:6", "4:6,0:2", "0:2147483648", "0:1x", " 0:1", "0:99999999999"})
        EXPECT_FALSE(parseSampleRanges(text).has_value()) << text;
}

TEST(SampleRanges, NeighboursBecomeOneAndGapsStay) {
    EXPECT_EQ(textOf(unionOf({{8, 16}}, {{0, 8}})), "0:16");
    EXPECT_EQ(textOf(unionOf({{0, 8}, {16, 24}}, {{8, 16}})), "0:24");
    EXPECT_EQ(textOf(unionOf({{0, 8}}, {{16, 24}})), "0:8,16:24");
    EXPECT_EQ(countOf(unionOf({{0, 8}}, {{16, 24}})), 16u);
}

TEST(SampleRanges, OverlapsAreFoundWhereverTheyLie) {
    EXPECT_FALSE(overlapOf({{0, 8}, {16, 24}}, {{8, 16}, {24, 32}}).has_value());
    EXPECT_EQ(overlapOf({{0, 8}, {16, 24}}, {{23, 25}}), (SampleRange{23, 24}));
    EXPECT_EQ(overlapOf({{0, 100}}, {{50, 51}}), (SampleRange{50, 51}));
}

} // namespace
} // namespace lavalight
