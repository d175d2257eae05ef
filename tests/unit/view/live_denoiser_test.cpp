// Denoising beside a render: the newest picture wins, and none comes of an image that is gone.
#include "view/live_denoiser.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "base/error.h"

namespace lavalight::test {
namespace {

using namespace std::chrono_literals;

// A denoiser that starts a picture and then waits until it is let go on, or given up.
class LiveDenoiserTest : public testing::Test {
  protected:
    [[nodiscard]] LiveDenoiser::Denoise denoise() {
        return [this](const DenoiseOrder& order, const KeepGoing& keepGoing) {
            ++started_;
            while (permits_ == 0 && keepGoing())
                std::this_thread::sleep_for(1ms);
            std::optional<DenoisedPicture> picture;
            if (!keepGoing()) {
                ++givenUp_;
                return picture;
            }
            --permits_;
            if (order.samples == kBroken)
                throw Error("cannot denoise: broken");
            picture.emplace().samples = order.samples;
            return picture;
        };
    }
    static DenoiseOrder orderOf(uint32_t samples) {
        DenoiseOrder order;
        order.samples = samples;
        return order;
    }
    template <typename Condition>
    static void waitFor(const Condition& condition) {
        const auto deadline = std::chrono::steady_clock::now() + 20s;
        while (!condition()) {
            ASSERT_LT(std::chrono::steady_clock::now(), deadline);
            std::this_thread::sleep_for(1ms);
        }
    }
    // Samples of the picture that is there next.
    uint32_t next(size_t side) {
        std::optional<DenoisedPicture> picture;
        waitFor([&] { return (picture = denoiser_.take(side)).has_value(); });
        return picture ? picture->samples : 0;
    }

    static constexpr uint32_t kBroken = 666;
    std::atomic<int> started_ = 0;
    std::atomic<int> permits_ = 0;
    std::atomic<int> givenUp_ = 0;
    std::atomic<int> woken_ = 0;
    LiveDenoiser denoiser_{[this] { return denoise(); }, [this] { ++woken_; }};
};

TEST_F(LiveDenoiserTest, APictureComesOnceAndWakes) {
    permits_ = 1;
    denoiser_.order(0, orderOf(4));
    EXPECT_EQ(next(0), 4u);
    EXPECT_FALSE(denoiser_.take(0));
    waitFor([&] { return denoiser_.isIdle() && woken_ == 1; });
}

TEST_F(LiveDenoiserTest, OfPicturesThatWaitTheNewestIsDenoised) {
    denoiser_.order(0, orderOf(1));
    waitFor([&] { return started_ == 1; });
    EXPECT_FALSE(denoiser_.isIdle());
    for (const uint32_t samples : {2u, 4u, 8u})
        denoiser_.order(0, orderOf(samples));
    permits_ = 2;
    waitFor([&] { return denoiser_.isIdle(); });
    EXPECT_EQ(started_, 2) << "those of 2 and 4 samples were never begun";
    EXPECT_EQ(denoiser_.take(0)->samples, 8u);
}

TEST_F(LiveDenoiserTest, WhatIsUnderWayIsGivenUpWhenTheImageRestarts) {
    denoiser_.order(0, orderOf(1));
    waitFor([&] { return started_ == 1; });
    denoiser_.order(0, orderOf(2));
    denoiser_.restart(0);
    waitFor([&] { return givenUp_ == 1 && denoiser_.isIdle(); });
    EXPECT_FALSE(denoiser_.take(0));
    EXPECT_EQ(started_, 1) << "what waited is gone, too";
    permits_ = 1;
    denoiser_.order(0, orderOf(16));
    EXPECT_EQ(next(0), 16u);
}

TEST_F(LiveDenoiserTest, APictureThatWasReadyBeforeTheRestartNeverComes) {
    permits_ = 1;
    denoiser_.order(0, orderOf(4));
    waitFor([&] { return denoiser_.isIdle(); });
    denoiser_.restart(0);
    EXPECT_FALSE(denoiser_.take(0));
}

TEST_F(LiveDenoiserTest, TheOtherSideGoesOnWhenOneRestarts) {
    denoiser_.order(0, orderOf(1));
    waitFor([&] { return started_ == 1; });
    denoiser_.order(1, orderOf(2));
    denoiser_.restart(0);
    permits_ = 1;
    EXPECT_EQ(next(1), 2u);
    EXPECT_FALSE(denoiser_.take(0));
}

TEST_F(LiveDenoiserTest, AFailureIsToldOnceAndTheNextPictureComes) {
    permits_ = 2;
    denoiser_.order(0, orderOf(kBroken));
    std::string error;
    waitFor([&] { return !(error = denoiser_.takeError()).empty(); });
    EXPECT_EQ(error, "cannot denoise: broken");
    EXPECT_EQ(denoiser_.takeError(), "");
    denoiser_.order(0, orderOf(3));
    EXPECT_EQ(next(0), 3u);
}

TEST_F(LiveDenoiserTest, EndsInTheMidstOfAPicture) {
    auto denoiser = std::make_unique<LiveDenoiser>([this] { return denoise(); }, [] {});
    denoiser->order(0, orderOf(1));
    waitFor([&] { return started_ == 1; });
    denoiser.reset();
    EXPECT_EQ(givenUp_, 1);
}

TEST(LiveDenoiserWithoutLibrary, SaysWhyAndEnds) {
    std::atomic<int> woken = 0;
    LiveDenoiser denoiser([]() -> LiveDenoiser::Denoise { throw Error("cannot denoise: no library"); },
                          [&] { ++woken; });
    while (woken == 0)
        std::this_thread::sleep_for(1ms);
    EXPECT_EQ(denoiser.whyNot(), "cannot denoise: no library");
    denoiser.order(0, {});
}

} // namespace
} // namespace lavalight::test
