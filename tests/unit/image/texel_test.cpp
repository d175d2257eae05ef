// Tests of texels on the CPU.
#include "image/texel.h"

#include <array>
#include <cstring>

#include <gtest/gtest.h>

namespace lavalight::test {
namespace {

TEST(Texel, SixteenBitsAreReadInFullAndEightAreTheSameNumberTimes257) {
    const std::vector<uint16_t> values = {0, 1, 32768, 65535, 257 * 3, 257 * 7, 257 * 11, 257 * 13};
    Picture fine{"fine", 2, 1, true, std::vector<uint8_t>(2 * values.size())};
    std::memcpy(fine.bytes.data(), values.data(), fine.bytes.size());
    const Picture coarse{"coarse", 2, 1, false, {0, 0, 128, 255, 3, 7, 11, 13}};
    EXPECT_EQ(texelOf(fine, 0, 0, false), glm::dvec4(0.0, 1.0 / 65535.0, 32768.0 / 65535.0, 1.0));
    for (const bool isSrgb : {false, true})
        for (glm::length_t channel = 0; channel < 4; ++channel)
            EXPECT_NEAR(texelOf(fine, 1, 0, isSrgb)[channel], texelOf(coarse, 1, 0, isSrgb)[channel], 1e-12);
}

TEST(Texel, SrgbIsDecodedButForAlpha) {
    const Picture grey{"grey", 1, 1, false, {188, 10, 255, 188}};
    const glm::dvec4 texel = texelOf(grey, 0, 0, true);
    EXPECT_NEAR(texel.r, 0.5029, 1e-4);                // above the linear part: ((c + 0.055) / 1.055)^2.4
    EXPECT_NEAR(texel.g, 10.0 / 255.0 / 12.92, 1e-12); // within it
    EXPECT_EQ(texel.b, 1.0);
    EXPECT_EQ(texel.a, 188.0 / 255.0);
}

TEST(Texel, CoordinatesWrapAsTheirSamplerSays) {
    for (const auto& [i, repeated, clamped, mirrored] :
         {std::array<int64_t, 4>{-1, 3, 0, 0}, {-5, 3, 0, 3}, {4, 0, 3, 3}, {9, 1, 3, 1}, {2, 2, 2, 2}}) {
        EXPECT_EQ(wrapTexel(i, 4, Wrap::repeat), repeated) << i;
        EXPECT_EQ(wrapTexel(i, 4, Wrap::clamp), clamped) << i;
        EXPECT_EQ(wrapTexel(i, 4, Wrap::mirror), mirrored) << i;
    }
}

} // namespace
} // namespace lavalight::test
