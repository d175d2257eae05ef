// The drink: bodies within each other, against a renderer that is told each interface by itself.
#include <gtest/gtest.h>

#include "session/builtin.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class NestedGlass : public DeviceTest {};

// tests/references/nested_glass_mean.py made it: Mitsuba 3.9.1, 24 renders of 512 samples a pixel.
TEST_F(NestedGlass, HasTheMeanOfMitsubaWithinHalfAPercent) {
    const glm::dvec3 expected(0.437936, 0.490599, 0.530069); // standard errors 0.00025, 0.00011, 0.00006
    Scene scene = loadScene("nested-glass");
    for (Mesh& mesh : scene.meshes)
        mesh.normals.clear();
    RenderSettings settings = imageSettings(48, 48, 512);
    settings.estimator.maxBounces = 64;
    const ImageMean mean = meanOf(renderScene(device(), scene, settings).rendering);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(mean.standardError[c], 0.001 * expected[c])
            << "channel " << c << ": too noisy to say anything";
        EXPECT_NEAR(mean.mean[c], expected[c], 0.005 * expected[c]) << "channel " << c;
    }
}

} // namespace
} // namespace lavalight::test
