// Windows of an image: their words, and what two of them have in common.
#include <gtest/gtest.h>

#include "film/film_windows.h"

namespace lavalight {
namespace {

TEST(FilmWindows, WordsComeBack) {
    for (const char* text : {"0,0,1x1", "3,64,5x7", "0,0,8x6 8,0,8x6 0,6,16x1", "16383,16383,1x1"})
        EXPECT_EQ(textOf(parsePixelWindows(text).value()), text);
    EXPECT_EQ(parsePixelWindow("3,64,5x7"), (PixelWindow{3, 64, 5, 7}));
}

TEST(FilmWindows, WhatIsNoWindowIsNothing) {
    for (const char* text :
         {"", "1", "1,2", "1,2,3", "1,2,3x", "1,2,0x4", "1,2,4x0", "-1,0,2x2", "1,2,3x4 ", " 1,2,3x4",
          "1,2,3x4x", "1,2,3,4", "16384,0,1x1", "0,0,1x16385", "99999999999,0,1x1", "0,0,4x4 3,3,2x2"})
        EXPECT_FALSE(parsePixelWindows(text).has_value()) << text;
    EXPECT_FALSE(parsePixelWindow("0,0,8x6 8,0,8x6").has_value());
}

TEST(FilmWindows, WindowsThatFillTheirBoundsBecomeOne) {
    const PixelWindows corner = unionOf({{0, 0, 8, 6}}, {{8, 6, 8, 6}});
    EXPECT_EQ(textOf(corner), "0,0,8x6 8,6,8x6");
    EXPECT_EQ(boundsOf(corner), (PixelWindow{0, 0, 16, 12}));
    EXPECT_EQ(pixelsOf(corner), 96u);
    const PixelWindows three = unionOf(corner, {{8, 0, 8, 6}});
    EXPECT_EQ(textOf(unionOf(three, {{0, 6, 8, 6}})), "0,0,16x12");
    EXPECT_EQ(textOf(unionOf({{8, 0, 8, 6}}, {{0, 0, 8, 6}})), "0,0,16x6");
}

TEST(FilmWindows, OverlapsAreFoundWhereverTheyLie) {
    EXPECT_FALSE(
        overlapOf(PixelWindows{{0, 0, 8, 6}, {8, 6, 8, 6}}, {{8, 0, 8, 6}, {0, 6, 8, 6}}).has_value());
    EXPECT_EQ(overlapOf(PixelWindows{{0, 0, 8, 6}, {8, 6, 8, 6}}, {{7, 5, 2, 2}}), (PixelWindow{7, 5, 1, 1}));
    EXPECT_EQ(overlapOf(PixelWindows{{0, 0, 100, 100}}, {{50, 60, 1, 2}}), (PixelWindow{50, 60, 1, 2}));
}

} // namespace
} // namespace lavalight
