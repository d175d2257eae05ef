// Tests of reading numbers: all of a text, or its front.
#include "base/parse.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace lavalight {
namespace {

TEST(ParseNumber, TakesWholeTextsOnly) {
    EXPECT_EQ(parseNumber<uint32_t>("4294967295"), 4294967295u);
    EXPECT_EQ(parseNumber<double>("-2.5e1"), -25.0);
    for (const char* text : {"", " 1", "1 ", "+1", "-1", "4294967296", "1x", "0x1", "x"})
        EXPECT_EQ(parseNumber<uint32_t>(text), std::nullopt) << text;
}

TEST(TakeNumber, LeavesWhatFollows) {
    std::string_view text = "12:34";
    EXPECT_EQ(takeNumber<uint32_t>(text), 12u);
    EXPECT_EQ(text, ":34");
    EXPECT_EQ(takeNumber<uint32_t>(text), std::nullopt);
    EXPECT_EQ(text, ":34");
    std::string_view large = "300,1";
    EXPECT_EQ(takeNumber<uint8_t>(large), std::nullopt);
    EXPECT_EQ(large, "300,1");
}

} // namespace
} // namespace lavalight
