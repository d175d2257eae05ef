// Tests of loops over all processors.
#include "base/parallel.h"

#include <gtest/gtest.h>

namespace lavalight {
namespace {

TEST(ForEachInParallel, VisitsEachNumberOnceAndReturnsWhenAllIsDone) {
    for (const std::size_t count : {0, 1, 2, 3, 10'000}) {
        std::vector<std::atomic<int>> visits(count + 1);
        forEachInParallel(count, [&](std::size_t i) { ++visits[i]; });
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(visits[i], 1) << i << " of " << count;
        EXPECT_EQ(visits[count], 0);
    }
}

} // namespace
} // namespace lavalight
