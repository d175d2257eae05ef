// Every combination of the estimators' settings has the mean of the default, on every scene of our own:
// hours, so no part of the test suite. tools/ci/validate builds and runs it.
#include <algorithm>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "session/builtin.h"
#include "support/estimator_variants.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class FullProduct : public DeviceTest, public testing::WithParamInterface<std::string> {};

TEST_P(FullProduct, HasOneMean) {
    const char* text = std::getenv("LAVALIGHT_VALIDATE_SAMPLES");
    const uint32_t samples = text != nullptr ? static_cast<uint32_t>(std::stoul(text)) : 4096;
    expectOneMean(device(), loadScene(GetParam()), answerable(GetParam(), allVariants()), {samples});
}

INSTANTIATE_TEST_SUITE_P(Scenes, FullProduct,
                         testing::Values("cornell-box", "cornell-glass", "veach-mis", "many-lights",
                                         "furnace", "large-small-light", "glass-caustic", "nested-glass"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

} // namespace
} // namespace lavalight::test
