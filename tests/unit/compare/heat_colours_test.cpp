// The colours of maps.
#include "compare/heat_colours.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lavalight {
namespace {

// The first, the 65th, the 129th and the last of matplotlib's table of 256 colours.
TEST(HeatColour, IsMagma) {
    const auto expectNear = [](float share, uint32_t r, uint32_t g, uint32_t b) {
        const uint32_t colour = heatColour(share);
        EXPECT_NEAR(colour & 255, r, 3.0) << share;
        EXPECT_NEAR(colour >> 8 & 255, g, 3.0) << share;
        EXPECT_NEAR(colour >> 16 & 255, b, 3.0) << share;
        EXPECT_EQ(colour >> 24, 255u);
    };
    expectNear(0.0f, 0, 0, 4);
    expectNear(64.0f / 255.0f, 81, 18, 124);
    expectNear(128.0f / 255.0f, 183, 55, 121);
    expectNear(1.0f, 252, 253, 191);
}

TEST(HeatColour, IsDefinedEverywhere) {
    EXPECT_EQ(heatColour(-1.0f), heatColour(0.0f));
    EXPECT_EQ(heatColour(std::nanf("")), heatColour(0.0f));
    EXPECT_EQ(heatColour(7.0f), heatColour(1.0f));
}

} // namespace
} // namespace lavalight
