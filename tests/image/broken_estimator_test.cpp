// Estimators broken on purpose: the test that compares means has to notice, or it proves nothing.
#include <iostream>
#include <string>

#include <gtest/gtest.h>

#include "session/builtin.h"
#include "support/mean_test.h"
#include "support/patched_kernel.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class BrokenEstimatorTest : public DeviceTest {
  protected:
    void expectNotice(const std::string& sceneName, const std::string& from, const std::string& to,
                      uint32_t samples = 1024) {
        const Scene scene = loadScene(sceneName);
        RenderSettings settings = imageSettings(32, 32, samples);
        const RenderResult sound = renderScene(device(), scene, settings);
        settings.estimator.seed = 1;
        const RenderResult broken = renderScene(device(), scene, settings, [&](std::string_view name) {
            return name.starts_with("accumulate") ? embeddedKernel(name)
                                                  : patchedKernel(name, {"scene/path_vertex.glsl", from, to});
        });
        const MeanComparison comparison = compareMeans(broken.rendering, sound.rendering);
        std::cout << sceneName << ": " << comparison.text() << "\n";
        EXPECT_FALSE(comparison.same()) << comparison.text();
    }
};

TEST_F(BrokenEstimatorTest, RouletteThatDoesNotMakeUpForTheDeadIsNoticed) {
    expectNotice("cornell-box", "path.throughput /= survival;", "");
}

TEST_F(BrokenEstimatorTest, ADensityOffByFivePercentIsNoticed) {
    expectNotice("cornell-box", "(weight / light.pdf)", "(weight / (1.05 * light.pdf))");
}

TEST_F(BrokenEstimatorTest, WeightsThatDoNotSumToOneAreNoticed) {
    expectNotice("veach-mis", "misWeight(kMis, bsdfPdf, lightPdf)",
                 "misWeight(kMisBalance, bsdfPdf, lightPdf)", 4096);
}

TEST_F(BrokenEstimatorTest, LightThatCountsTwiceIsNoticed) {
    expectNotice("cornell-box", "kMis == kMisOff ? 0.0 : misWeight(kMis, bsdfPdf, lightPdf)", "1.0");
}

} // namespace
} // namespace lavalight::test
