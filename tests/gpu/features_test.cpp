// Kernels find a scene's features in two specialisation constants of 32 bits.
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "device_scene/scene_features.h"
#include "shared/frame.h"
#include "support/environment_variable.h"
#include "support/run_kernel.h"
#include "support/temporary_folder.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

class FeaturesTest : public DeviceTest {
  protected:
    // Whether the kernel sees kFeatureSpecular, Lens, SmoothLobes, Solids, and the features 31 and 63: 1 or
    // 0.
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

TEST_F(FeaturesTest, KernelsOfTheCacheHaveTheirOwnConstants) {
    const TemporaryFolder folder;
    const EnvironmentVariable cache("LAVALIGHT_CACHE", folder.path().string());
    for (int run = 0; run < 2; ++run) { // made, and found
        EXPECT_EQ(seenWith(kFeatureLens), (std::vector<uint32_t>{0, 1, 0, 0, 0, 0})) << run;
        EXPECT_EQ(seenWith(kFeatureSpecular), (std::vector<uint32_t>{1, 0, 0, 0, 0, 0})) << run;
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "kernels"), {}), 2);
}

TEST_F(FeaturesTest, ConstantsThatAKernelDoesNotDeclareChangeNothingOfIt) {
    const gpu::KernelCode code = test_kernels::find("features_test");
    auto constants = featureConstants(kFeatureLens);
    const std::vector<gpu::SpecialisationConstant> all(constants.begin(), constants.end());
    std::vector<gpu::SpecialisationConstant> more = all;
    more.push_back({CONSTANT_SAMPLER, 1});
    EXPECT_EQ(gpu::declaredIn(code.spirv, more), all);
    EXPECT_TRUE(gpu::declaredIn(code.spirv, {}).empty());
}

} // namespace
} // namespace lavalight::test
