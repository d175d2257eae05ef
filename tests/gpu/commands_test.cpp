// What Commands says about the time that kernels took.
#include <chrono>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

class CommandsTest : public DeviceTest {
  protected:
    static constexpr uint32_t kGroups = 1000;

    CommandsTest()
        : kernel_(device(), test_kernels::find("random_unit_test")),
          words_(device(), "words", 64ull * kGroups * sizeof(uint32_t), gpu::BufferUse::storage),
          numbers_(device(), "numbers", 64ull * kGroups * sizeof(float), gpu::BufferUse::storage) {}

    // Runs three dispatches of one submission.
    gpu::KernelTimes timesOf(gpu::Timing timing) {
        gpu::ResourceTable resources;
        resources.set("In", words_);
        resources.set("Out", numbers_);
        const gpu::BoundKernel bound(device(), kernel_, resources);
        gpu::Commands commands(device());
        commands.begin(timing);
        commands.fill(words_, 1);
        for (int i = 0; i < 3; ++i)
            commands.dispatch(bound, kGroups);
        commands.submitAndWait();
        return commands.times();
    }

  private:
    gpu::Kernel kernel_;
    gpu::Buffer words_;
    gpu::Buffer numbers_;
};

TEST_F(CommandsTest, EitherTimingCountsEveryDispatchAndNoMoreThanTheTimeThatPassed) {
    for (const gpu::Timing timing : {gpu::Timing::eachKernel, gpu::Timing::together}) {
        if (timing == gpu::Timing::eachKernel && device().limits().timestampNanoseconds == 0.0)
            continue; // nothing is timed
        const auto start = std::chrono::steady_clock::now();
        const gpu::KernelTimes times = timesOf(timing);
        const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        ASSERT_EQ(times.size(), 1u);
        const gpu::KernelTime& time = times.begin()->second;
        EXPECT_EQ(time.dispatches, 3u);
        EXPECT_GT(time.seconds, 0.0);
        EXPECT_LT(time.seconds, passed);
    }
}

} // namespace
} // namespace lavalight::test
