// Kernels find the features of a scene in two words.
#include <vector>

#include <gtest/gtest.h>

#include "device_scene/scene_features.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

class FeaturesTest : public DeviceTest {
  protected:
    // Of kFeatureSpecular, Lens, SmoothLobes, Solids, and the numbers 31 and 63.
    std::vector<uint32_t> seenWith(SceneFeatures features) {
        const auto constants = featureConstants(features);
        KernelRunner runner(device(), test_kernels::find("features_test"), {}, constants);
        return runner.run<uint32_t>(std::span<const uint32_t>(), 6);
    }
};

TEST_F(FeaturesTest, EachIsFoundAloneInItsWord) {
    const std::vector<SceneFeatures> features{kFeatureSpecular, kFeatureLens,       kFeatureSmoothLobes,
                                              kFeatureSolids,   SHARED_FEATURE(31), SHARED_FEATURE(63)};
    for (size_t i = 0; i < features.size(); ++i) {
        std::vector<uint32_t> expected(features.size(), 0u);
        expected[i] = 1;
        EXPECT_EQ(seenWith(features[i]), expected) << i;
    }
    EXPECT_EQ(seenWith(0), std::vector<uint32_t>(features.size(), 0u));
    EXPECT_EQ(seenWith(~SceneFeatures{0}), std::vector<uint32_t>(features.size(), 1u));
}

} // namespace
} // namespace lavalight::test
