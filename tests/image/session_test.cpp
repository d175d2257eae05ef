// A render session without a command line, as a server or the window uses it.
#include <array>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "session/render_session.h"
#include "support/temporary_folder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

RenderPlan smallPlan(uint32_t seed = 0) {
    RenderPlan plan;
    plan.scene = "cornell-box";
    plan.settings.image.width = 24;
    plan.settings.image.height = 16;
    plan.settings.stop.samples = 8;
    plan.settings.estimator.seed = seed;
    plan.device = testDeviceConfig();
    return plan;
}

// Renders to the end, or until `keepGoing` says stop.
RenderJob rendered(
    RenderSession& session, const Outputs& outputs = {},
    const RenderJob::KeepGoing& keepGoing = [](double) { return true; }) {
    RenderJob job = session.prepare({}, outputs);
    Checkpoint none({}, {});
    session.render(job, none, false, keepGoing);
    return job;
}

std::vector<uint32_t> filmOf(uint32_t seed) {
    RenderSession session(smallPlan(seed));
    return rendered(session).renderer->film().read().words;
}

TEST(Session, TwoAtOnceInThreadsHaveTheBitsOfOneAfterTheOther) {
    const std::array<std::vector<uint32_t>, 2> alone{filmOf(1), filmOf(2)};
    ASSERT_NE(alone[0], alone[1]);
    std::array<std::vector<uint32_t>, 2> together;
    {
        std::jthread first([&] { together[0] = filmOf(1); });
        std::jthread second([&] { together[1] = filmOf(2); });
    }
    EXPECT_EQ(together, alone);
}

TEST(Session, ACallbackThatSaysNoEndsTheRenderAndTheImageSoFarIsWritten) {
    const TemporaryFolder folder;
    const Outputs outputs{(folder.path() / "a.exr").string(),
                          (folder.path() / "a.png").string(),
                          (folder.path() / "a.json").string(),
                          {}};
    RenderPlan plan = smallPlan();
    plan.settings.work.waveSize = 24 * 16; // one sample a wave
    RenderSession session(plan);
    double last = 0.0;
    RenderJob job = rendered(session, outputs, [&](double fraction) {
        EXPECT_GE(fraction, last);
        last = fraction;
        return fraction < 0.5;
    });
    EXPECT_EQ(job.report.stop, StopReason::interrupted);
    session.write(job, outputs);
    EXPECT_EQ(job.report.samples, 4u * 24 * 16);
    for (const std::string& file : {outputs.exr, outputs.png, outputs.report})
        EXPECT_FALSE(readFile(file).empty()) << file;
}

TEST(Session, KernelsOfOneImageServeTheNextAndItsBitsAreThoseOfAFreshSession) {
    RenderSession session(smallPlan());
    RenderJob first = rendered(session);
    const std::vector<uint32_t> words = first.renderer->film().read().words;
    session.finish(std::move(first));
    RenderJob second = rendered(session);
    EXPECT_EQ(second.renderer->film().read().words, words);
}

TEST(Session, RendersOnADeviceThatIsOpenWithTheSettingsOfTheMoment) {
    RenderPlan plan = smallPlan(1);
    plan.device.wanted = "no such device";
    RenderSession session(plan, testDevice());
    RenderJob first = rendered(session);
    EXPECT_EQ(first.device, &testDevice());
    EXPECT_EQ(first.renderer->film().read().words, filmOf(1));
    session.finish(std::move(first));
    session.use(smallPlan(2).settings);
    EXPECT_EQ(rendered(session).renderer->film().read().words, filmOf(2));
}

// A library does not end the process: what a slow kernel means is the caller's to say.
TEST(Session, AKernelThatTakesLongerThanAllowedIsReportedAndWaitedFor) {
    RenderPlan plan = smallPlan(1);
    std::vector<std::string> reports;
    plan.device.kernelTimeout = 1e-6;
    plan.device.onKernelTimeout = [&](const std::string& message) { reports.push_back(message); };
    RenderSession session(plan);
    EXPECT_EQ(rendered(session).renderer->film().read().words, filmOf(1));
    ASSERT_FALSE(reports.empty());
    EXPECT_NE(reports.front().find("--kernel-timeout"), std::string::npos) << reports.front();
}

TEST(Session, FailuresAreExceptionsThatNameWhatFailed) {
    RenderPlan plan = smallPlan();
    plan.scene = "no-such-scene";
    RenderSession missing(plan);
    EXPECT_THROW(static_cast<void>(missing.prepare({}, {})), Error);
    plan = smallPlan();
    plan.settings.estimator.maxBounces = kMaxBounceLimit + 1;
    RenderSession wrong(plan);
    EXPECT_THROW(static_cast<void>(wrong.prepare({}, {})), UsageError);
    plan = smallPlan();
    plan.device.wanted = "no such device";
    RenderSession nowhere(plan);
    EXPECT_THROW(static_cast<void>(nowhere.prepare({}, {})), Error);
    EXPECT_THROW(requireApart({"a.exr", "a.exr", {}, {}}, {}), UsageError);
}

} // namespace
} // namespace lavalight::test
