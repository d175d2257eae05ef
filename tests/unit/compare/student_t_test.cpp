// Tails of Student's t against values that are known otherwise.
#include "compare/student_t.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace lavalight {
namespace {

void expectRatioOne(double value, double expected) {
    EXPECT_NEAR(value / expected, 1.0, 1e-9) << value << " and " << expected;
}

TEST(StudentTail, HasTheClosedFormsOfOneAndTwoDegrees) {
    for (const double t : {0.1, 1.0, 3.0, 30.0, 1e4}) {
        expectRatioOne(studentTwoSidedTail(t, 1.0), 2.0 / std::numbers::pi * std::atan(1.0 / t));
        const double root = std::sqrt(2.0 + t * t);
        expectRatioOne(studentTwoSidedTail(t, 2.0),
                       2.0 / (root * (root + t))); // 1 - t / root, without cancellation
    }
}

// Computed with SciPy 1.17.1, 2 * scipy.stats.t.sf(t, degrees).
TEST(StudentTail, AgreesWithAnotherImplementation) {
    expectRatioOne(studentTwoSidedTail(3.0, 15.0), 8.972737477223e-03);
    expectRatioOne(studentTwoSidedTail(10.0, 15.0), 4.996898142925e-08);
    expectRatioOne(studentTwoSidedTail(0.5, 100.0), 6.181735658309e-01);
    expectRatioOne(studentTwoSidedTail(20.0, 1e4), 2.764652586541e-87);
}

TEST(StudentTail, WithManyDegreesIsThatOfTheNormalDistribution) {
    EXPECT_NEAR(studentTwoSidedTail(4.0, 9.9e6) / std::erfc(4.0 / std::numbers::sqrt2), 1.0, 1e-5);
    EXPECT_NEAR(studentTwoSidedTail(4.0, 1.1e7) / std::erfc(4.0 / std::numbers::sqrt2), 1.0, 1e-5);
    EXPECT_EQ(studentTwoSidedTail(0.0, 7.0), 1.0);
    EXPECT_EQ(studentTwoSidedTail(std::numeric_limits<double>::infinity(), 7.0), 0.0);
}

} // namespace
} // namespace lavalight
