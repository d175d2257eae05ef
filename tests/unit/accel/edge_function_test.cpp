// What lib/math/ray_triangle.glsl builds on: the sign of a 2-D cross product in floats is right or lost to 0,
// never wrong.
#include <gtest/gtest.h>

#include "support/random_numbers.h"

namespace lavalight::test {
namespace {

// The cross product as in the shader, each operation rounded.
float edgeFunction(const glm::vec2& a, const glm::vec2& b) {
    const volatile float left = a.x * b.y;
    const volatile float right = a.y * b.x;
    return left - right;
}

// The true sign: products of floats are exact in double, and so is their order.
int exactSign(const glm::vec2& a, const glm::vec2& b) {
    const double left = double{a.x} * b.y;
    const double right = double{a.y} * b.x;
    return (left > right) - (left < right);
}

struct Counts {
    uint32_t wrong = 0;
    uint32_t lost = 0;
};

// Pairs of which the second is the first times a factor, but for the last bits: where rounding decides.
Counts countSigns(float size) {
    Random random(1);
    Counts counts;
    for (int i = 0; i < 4000000; ++i) {
        const glm::vec2 a(size * random.between(-1, 1), size * random.between(-1, 1));
        const float factor = random.between(-2, 2);
        const glm::vec2 noise(random.between(-1, 1), random.between(-1, 1));
        const glm::vec2 b = factor * a * (1.0f + 0x1p-22f * noise);
        const float value = edgeFunction(a, b);
        const int sign = (value > 0.0f) - (value < 0.0f);
        const int exact = exactSign(a, b);
        counts.wrong += sign != 0 && sign != exact;
        counts.lost += sign == 0 && exact != 0;
        EXPECT_EQ(edgeFunction(b, a), -value);
    }
    return counts;
}

TEST(EdgeFunction, NeverHasTheWrongSign) {
    const Counts counts = countSigns(1.0f);
    EXPECT_EQ(counts.wrong, 0u);
    EXPECT_GT(counts.lost, 0u) << "no pair was close enough to test rounding";
}

TEST(EdgeFunction, NeverHasTheWrongSignWhereProductsUnderflow) {
    const Counts counts = countSigns(1e-21f);
    EXPECT_EQ(counts.wrong, 0u);
    EXPECT_GT(counts.lost, 0u);
}

} // namespace
} // namespace lavalight::test
