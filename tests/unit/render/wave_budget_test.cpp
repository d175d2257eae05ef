// Waves grow while a device is quick and shrink where it is not.
#include <gtest/gtest.h>

#include "render/wave_budget.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kMost = 1u << 18;

// Slots after `waves` waves on a device of that speed, and the longest time that one took.
struct Course {
    uint32_t slots = 0;
    double longest = 0.0;
};
Course run(WaveBudget budget, double slotsPerSecond, int waves) {
    Course course;
    for (int i = 0; i < waves; ++i) {
        const double seconds = budget.slots() / slotsPerSecond;
        course.longest = std::max(course.longest, seconds);
        budget.took(seconds);
    }
    course.slots = budget.slots();
    return course;
}

TEST(WaveBudget, AQuickGpuSoonHasWholeWaves) {
    EXPECT_EQ(WaveBudget(kMost, false).slots(), WaveBudget::kFewest);
    EXPECT_EQ(run({kMost, false}, 1e8, 6).slots, kMost);
    EXPECT_EQ(run({kMost, false}, 1e8, 100).slots, kMost);
}

TEST(WaveBudget, ASlowGpuIsNeverKeptTooLong) {
    for (const double speed : {5e3, 2e4, 1e5, 3e5}) {
        const Course course = run({kMost, false}, speed, 100);
        EXPECT_LE(course.longest, WaveBudget::kLongest) << speed;
        EXPECT_GE(course.slots / speed, WaveBudget::kLongest / 8) << speed;
    }
}

TEST(WaveBudget, ACpuStartsWithAWaveOfTheUsualSize) {
    EXPECT_EQ(WaveBudget(kMost, true).slots(), kMost);
    EXPECT_EQ(run({kMost, true}, 5e5, 100).slots, kMost);
    EXPECT_LE(run({kMost, true}, 1e5, 100).slots / 1e5, WaveBudget::kLongest);
}

TEST(WaveBudget, WavesOfAQuickCpuGrowBeyondTheFirst) {
    EXPECT_EQ(WaveBudget(4 * kMost, true).slots(), WaveBudget::kFirstOnCpu);
    EXPECT_EQ(run({4 * kMost, true}, 1e7, WaveBudget::kQuickOnCpu - 1).slots, WaveBudget::kFirstOnCpu);
    EXPECT_EQ(run({4 * kMost, true}, 1e7, WaveBudget::kQuickOnCpu).slots, 2 * WaveBudget::kFirstOnCpu);
    EXPECT_EQ(run({4 * kMost, true}, 1e7, 100).slots, 4 * kMost);
    EXPECT_EQ(run({4 * kMost, true}, 9e5, 100).slots, WaveBudget::kFirstOnCpu) << "which takes 0.29 s";
}

TEST(WaveBudget, SizesThatAreNoPowerOfTwoAreReached) {
    EXPECT_EQ(run({100'000, false}, 1e8, 20).slots, 100'000u);
    EXPECT_EQ(run({1000, false}, 1e8, 20).slots, 1000u);
    EXPECT_EQ(run({1000, true}, 10.0, 20).slots, 1000u) << "not less than the fewest, or all";
}

} // namespace
} // namespace lavalight::test
