// Rays that start on a surface neither hit it again nor slip through its neighbours, at any scale and far
// from the origin.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "device_scene/gpu_scene.h"
#include "inspect/ray_sets.h"
#include "shared/wavefront.h"
#include "support/closed_meshes.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Answer { // as in the kernel
    float t;
    float sameSideT;
    float otherSideT;
};

enum class Side { outside, inside };

constexpr size_t kRays = 40000;

// Rays towards random points within the mesh, from far outside or from within.
std::vector<Ray> raysFrom(Side side, const Placement& placement) {
    Random random(1);
    const auto within = [&](float radius) {
        return placement.centre() + radius * placement.scale * random.unit() * random.direction();
    };
    std::vector<Ray> rays;
    while (rays.size() < kRays) {
        const glm::vec3 target = within(0.9f);
        const glm::vec3 origin = side == Side::inside
                                     ? within(0.3f)
                                     : placement.centre() + 3.0f * placement.scale * random.direction();
        if (target != origin)
            rays.push_back(freeRay(origin, glm::normalize(target - origin)));
    }
    return rays;
}

class SelfIntersectionTest : public DeviceTest {
  protected:
    // Expects of rays from that side of a convex mesh that they hit it where they go on inside, and nothing
    // where they go on outside.
    void expectNoFalseHitNorLeak(Side side, const ClosedMesh& shape) {
        for (const Placement& placement : kPlacements) {
            SCOPED_TRACE(placement.name());
            const GpuScene scene(device(), packScene(sceneOf(placed(shape, placement))));
            gpu::ResourceTable resources;
            scene.addTo(resources);
            KernelRunner runner(device(), test_kernels::find("self_intersection_test"), resources);
            size_t falseHits = 0;
            size_t leaks = 0;
            for (const Answer& answer : runner.map<Answer>(raysFrom(side, placement))) {
                ASSERT_FALSE(std::isinf(answer.t));
                leaks += std::isinf(side == Side::inside ? answer.sameSideT : answer.otherSideT) ? 1 : 0;
                falseHits += std::isinf(side == Side::inside ? answer.otherSideT : answer.sameSideT) ? 0 : 1;
            }
            EXPECT_EQ(falseHits, 0u);
            EXPECT_EQ(leaks, 0u);
        }
    }
};

TEST_F(SelfIntersectionTest, RaysFromTheOutsideOfACubeNeverHitItAgainNorMissItsInside) {
    expectNoFalseHitNorLeak(Side::outside, makeCube());
}

TEST_F(SelfIntersectionTest, RaysFromTheInsideOfACubeNeverLeave) {
    expectNoFalseHitNorLeak(Side::inside, makeCube());
}

TEST_F(SelfIntersectionTest, RaysFromTheOutsideOfAnIcosphereNeverHitItAgainNorMissItsInside) {
    expectNoFalseHitNorLeak(Side::outside, makeIcosphere(2));
}

TEST_F(SelfIntersectionTest, RaysFromTheInsideOfAnIcosphereNeverLeave) {
    expectNoFalseHitNorLeak(Side::inside, makeIcosphere(2));
}

} // namespace
} // namespace lavalight::test
