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

// Waits until the condition holds; false: it does not within ten seconds.
template <class Condition>
bool becomesTrue(const Condition& condition) {
    using Clock = std::chrono::steady_clock;
    for (const Clock::time_point end = Clock::now() + std::chrono::seconds(10); Clock::now() < end;) {
        if (condition())
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

TEST(ForEachInParallel, HelpsALoopThatBeganWhileAllThreadsWereBusy) {
    const std::size_t all = std::thread::hardware_concurrency();
    if (all < 2)
        GTEST_SKIP() << "there is one processor";
    std::atomic<bool> isFirstOver = false;
    std::atomic<std::size_t> inFirst = 0;
    std::thread first([&] {
        forEachInParallel(all, [&](std::size_t) {
            ++inFirst;
            EXPECT_TRUE(becomesTrue([&] { return isFirstOver.load(); }));
        });
    });
    EXPECT_TRUE(becomesTrue([&] { return inFirst == all; }));
    std::atomic<bool> isHelped = false;
    const std::thread::id here = std::this_thread::get_id();
    forEachInParallel(2, [&](std::size_t) {
        isFirstOver = true; // its threads are free from now on
        if (std::this_thread::get_id() != here)
            isHelped = true;
        EXPECT_TRUE(becomesTrue([&] { return isHelped.load(); }));
    });
    first.join();
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
