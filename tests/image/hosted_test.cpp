// What the host's half of the schedule "hosted" does where rays or numbers are awkward.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "device_scene/gpu_scene.h"
#include "inspect/ray_sets.h"
#include "inspect/ray_tracer.h"
#include "kernels/kernel_source.h"
#include "support/patched_kernel.h"
#include "support/random_numbers.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class Hosted : public DeviceTest {
  protected:
    void SetUp() override {
        if (!device().description().sharesMemory)
            GTEST_SKIP() << "the host does not reach the device's memory";
    }
};

// Triangles of a millimetre, ten metres away, seen nearly from their edges: Embree's test and ours differ
// about many rays there.
TEST_F(Hosted, TrianglesSeenFromTheirEdgesAreMetWhereTheyAre) {
    Random random(1);
    Shape shape;
    std::vector<Ray> rays;
    for (uint32_t i = 0; i < 2000; ++i) {
        const glm::vec3 away = random.direction();
        const glm::vec3 across = glm::normalize(glm::cross(away, random.direction()));
        const glm::vec3 along = glm::normalize(away + 1e-4f * glm::cross(away, across));
        const glm::vec3 corner = 10.0f * away;
        shape.positions.insert(shape.positions.end(),
                               {corner, corner + 1e-3f * along, corner + 1e-3f * (across + 0.3f * along)});
        shape.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        for (int ray = 0; ray < 20; ++ray) {
            const float b1 = random.unit();
            const float b2 = (1.0f - b1) * random.unit();
            const glm::vec3 target = (1.0f - b1 - b2) * shape.positions[3 * i] +
                                     b1 * shape.positions[3 * i + 1] + b2 * shape.positions[3 * i + 2];
            rays.push_back(freeRay(glm::vec3(0.0f), glm::normalize(target)));
        }
    }
    const Scene scene = SceneBuilder().add(shape, lambert(glm::vec3(0.5f))).build();
    const Lights lights = collectLights(scene, glm::vec3(0.0f), LightSelection::power);
    for (const AcceleratorKind accelerator : {AcceleratorKind::bvh16, AcceleratorKind::embree}) {
        const GpuScene gpuScene(device(), packScene(scene, lights, accelerator));
        size_t met = 0;
        for (const TracedHit& hit : RayTracer(device(), gpuScene).closest(rays)) {
            if (!isSurface(hit.surface))
                continue;
            ++met;
            ASSERT_NEAR(hit.t, 10.0f, 0.002f) << "triangle " << hit.surface.primitive;
        }
        EXPECT_GT(met, rays.size() / 10);
    }
}

// A path of NaN that leaves the scene into the dark finds NaN there, and its sample is dropped.
TEST_F(Hosted, SamplesThatAreNoNumbersAreDroppedInTheDark) {
    const Scene scene = SceneBuilder()
                            .add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), lambert(glm::vec3(0.5f)))
                            .add(rectangle({0, 0, 9}, {0.1f, 0, 0}, {0, -0.1f, 0}), light(glm::vec3(1.0f)))
                            .camera(lookAt({0, 0, 2}, {0, 0, 0}, 0.5f))
                            .build();
    RenderSettings settings = imageSettings(16, 16, 4);
    settings.estimator.roulette = Roulette::off;
    const auto droppedBy = [&](Schedule schedule) {
        settings.work.schedule = schedule;
        return renderScene(device(), scene, settings,
                           [](std::string_view kernel) {
                               return patchedKernel(
                                   kernel, {"scene/path_vertex.glsl", "path.throughput *= next.weight;",
                                            "path.throughput *= uintBitsToFloat(0x7fc00000u);"});
                           })
            .tallies.droppedSamples;
    };
    EXPECT_EQ(droppedBy(Schedule::fused), 16u * 16u * 4u);
    EXPECT_EQ(droppedBy(Schedule::hosted), 16u * 16u * 4u);
}

} // namespace
} // namespace lavalight::test
