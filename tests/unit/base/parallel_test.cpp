// Tests of loops over all processors.
#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

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

TEST(ForEachInParallel, ThrowsWhatTheWorkThrowsAndServesTheNextLoop) {
    for (const std::size_t bad : {std::size_t{0}, std::size_t{500}}) {
        const auto work = [&](std::size_t i) {
            if (i == bad)
                throw std::runtime_error("bad");
        };
        EXPECT_THROW(forEachInParallel(1000, work), std::runtime_error);
    }
    std::atomic<int> visits = 0;
    forEachInParallel(1000, [&](std::size_t) { ++visits; });
    EXPECT_EQ(visits, 1000);
}

TEST(ForEachInParallel, RunsWithinALoopAndOnSeveralThreadsAtOnce) {
    std::atomic<int> visits = 0;
    const auto nested = [&](std::size_t) { forEachInParallel(10, [&](std::size_t) { ++visits; }); };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            for (int loop = 0; loop < 50; ++loop)
                forEachInParallel(10, nested);
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(visits, 4 * 50 * 10 * 10);
}

TEST(ForEachInParallel, WithALimitOfOneRunsOnTheCallingThread) {
    limitThreads(1);
    std::atomic<int> elsewhere = 0;
    const std::thread::id here = std::this_thread::get_id();
    forEachInParallel(20, [&](std::size_t) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // so that another thread could take one
        elsewhere += std::this_thread::get_id() == here ? 0 : 1;
    });
    limitThreads(0);
    EXPECT_EQ(elsewhere, 0);
}

} // namespace
} // namespace lavalight
