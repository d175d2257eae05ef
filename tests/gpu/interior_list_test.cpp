// The list of the solids that a path is in, step by step.
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "shared/interior_list.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Step { // as in the kernel, like the next
    uint32_t solid;
    uint32_t leaves;
};

struct Answer {
    std::array<uint32_t, kInteriorEntries> entries;
    uint32_t count;
    uint32_t overflow;
    uint32_t contains;
    uint32_t unused;
    bool operator==(const Answer&) const = default;
};

Step enter(uint32_t solid) {
    return {solid, 0};
}

Step leave(uint32_t solid) {
    return {solid, 1};
}

class InteriorListTest : public DeviceTest {
  protected:
    // What is on the list after each step.
    std::vector<Answer> after(const std::vector<Step>& steps) {
        KernelRunner runner(device(), test_kernels::find("interior_list_test"));
        return runner.map<Answer>(steps);
    }
};

TEST_F(InteriorListTest, KeepsTheOrderInWhichSolidsWereEntered) {
    const std::vector<Answer> lists = after({enter(7), enter(40000), enter(3), enter(9)});
    EXPECT_EQ(lists[0], (Answer{{7, 0, 0, 0}, 1, 0, 1, 0}));
    EXPECT_EQ(lists[1], (Answer{{7, 40000, 0, 0}, 2, 0, 1, 0}));
    EXPECT_EQ(lists[2], (Answer{{7, 40000, 3, 0}, 3, 0, 1, 0}));
    EXPECT_EQ(lists[3], (Answer{{7, 40000, 3, 9}, 4, 0, 1, 0}));
}

TEST_F(InteriorListTest, LosesASolidFromAnyPlace) {
    const std::vector<Step> entered{enter(1), enter(2), enter(3), enter(4)};
    const std::array<std::array<uint32_t, 4>, 4> left{
        {{2, 3, 4, 0}, {1, 3, 4, 0}, {1, 2, 4, 0}, {1, 2, 3, 0}}};
    for (uint32_t solid = 1; solid <= 4; ++solid) {
        std::vector<Step> steps = entered;
        steps.push_back(leave(solid));
        EXPECT_EQ(after(steps).back(), (Answer{left[solid - 1], 3, 0, 0, 0})) << solid;
    }
}

TEST_F(InteriorListTest, OfASolidEnteredTwiceTheInnerOneGoesFirst) {
    const std::vector<Answer> lists = after({enter(1), enter(2), enter(1), leave(1), leave(1), leave(1)});
    EXPECT_EQ(lists[3], (Answer{{1, 2, 0, 0}, 2, 0, 1, 0}));
    EXPECT_EQ(lists[4], (Answer{{2, 0, 0, 0}, 1, 0, 0, 0}));
    EXPECT_EQ(lists[5], lists[4]);
}

TEST_F(InteriorListTest, LeavingASolidThatIsNotOnItChangesNothing) {
    const std::vector<Answer> lists = after({leave(5), enter(1), leave(5)});
    EXPECT_EQ(lists[0], (Answer{{0, 0, 0, 0}, 0, 0, 0, 0}));
    EXPECT_EQ(lists[2], (Answer{{1, 0, 0, 0}, 1, 0, 0, 0}));
}

TEST_F(InteriorListTest, CountsTheSolidsThatFindNoRoom) {
    const std::vector<Answer> lists = after(
        {enter(1), enter(2), enter(3), enter(4), enter(5), enter(6), leave(6), leave(2), leave(5), leave(9)});
    EXPECT_EQ(lists[4], (Answer{{1, 2, 3, 4}, 4, 1, 0, 0}));
    EXPECT_EQ(lists[5], (Answer{{1, 2, 3, 4}, 4, 2, 0, 0}));
    EXPECT_EQ(lists[6], (Answer{{1, 2, 3, 4}, 4, 1, 0, 0}));
    EXPECT_EQ(lists[7], (Answer{{1, 3, 4, 0}, 3, 1, 0, 0}));
    EXPECT_EQ(lists[8], (Answer{{1, 3, 4, 0}, 3, 0, 0, 0}));
    EXPECT_EQ(lists[9], lists[8]);
}

TEST_F(InteriorListTest, CountsAtMostTheOverflowThatItHasBitsFor) {
    std::vector<Step> steps(300, enter(1));
    EXPECT_EQ(after(steps).back(), (Answer{{1, 1, 1, 1}, 4, kInteriorOverflowMask, 1, 0}));
}

TEST_F(InteriorListTest, TakesSolidsBeyondTheLastForThatOne) {
    const std::vector<Answer> lists = after({enter(70000), leave(80000)});
    EXPECT_EQ(lists[0], (Answer{{kLastSolid, 0, 0, 0}, 1, 0, 1, 0}));
    EXPECT_EQ(lists[1], (Answer{{0, 0, 0, 0}, 0, 0, 0, 0}));
}

} // namespace
} // namespace lavalight::test
