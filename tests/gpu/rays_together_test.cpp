// Rays that the host traces together find what each finds alone, whichever others are beside them.
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "device_scene/gpu_scene.h"
#include "inspect/ray_sets.h"
#include "inspect/ray_tracer.h"
#include "scene/procedural/dense_scene.h"
#include "support/closed_meshes.h"
#include "support/random_numbers.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

// Rounds of every kind of ray, by the environment: half a million rays each. 200 make a hundred million.
int rounds() {
    const char* text = std::getenv("LAVALIGHT_RAY_ROUNDS");
    return text == nullptr ? 4 : std::stoi(text);
}

class RaysTogether : public DeviceTest {
  protected:
    void SetUp() override {
        if (!device().description().sharesMemory)
            GTEST_SKIP() << "the host does not reach the device's memory";
    }
    [[nodiscard]] GpuScene upload(const Scene& scene) {
        const Lights lights = collectLights(scene, glm::vec3(0.0f), LightSelection::power);
        return {device(), packScene(scene, lights, AcceleratorKind::embree)};
    }
    // How many of the rays find something else together than alone, in the order given and in another.
    [[nodiscard]] static size_t differing(RayTracer& tracer, std::vector<Ray> rays, uint32_t seed) {
        size_t count = 0;
        for (int order = 0; order < 2; ++order) {
            const std::vector<TracedHit> alone = tracer.closest(rays);
            const std::vector<TracedHit> together = tracer.closestTogether(rays);
            for (size_t i = 0; i < rays.size(); ++i)
                count += alone[i].t != together[i].t || !isSameSurface(alone[i].surface, together[i].surface)
                             ? 1
                             : 0;
            std::shuffle(rays.begin(), rays.end(), std::mt19937(seed));
        }
        return count;
    }
};

TEST_F(RaysTogether, OfCamerasAndBouncesFindTheSame) {
    const Scene scene = makeDenseScene(20000);
    const std::vector<Triangle> triangles = sceneTriangles(scene);
    const GpuScene gpuScene = upload(scene);
    RayTracer tracer(device(), gpuScene);
    for (int round = 0; round < rounds(); ++round) {
        const auto seed = static_cast<uint32_t>(round + 1);
        const std::vector<Ray> camera = makeCameraRays(scene.cameras.front(), 50000, seed);
        const std::vector<SurfacePoint> points = hitPoints(camera, tracer.closest(camera), triangles);
        EXPECT_EQ(differing(tracer, camera, seed), 0u);
        EXPECT_EQ(differing(tracer, makeBounceRays(points, seed), seed), 0u);
    }
}

// Rays from `origin` to the first corner of each edge of the mesh, or to a random point of it.
std::vector<Ray> towardsEdges(const ClosedMesh& mesh, const glm::vec3& origin, bool isCorner,
                              Random& random) {
    std::vector<Ray> rays;
    for (const glm::uvec3& triangle : mesh.triangles)
        for (glm::length_t i = 0; i < 3; ++i) {
            const glm::dvec3 a(mesh.positions[triangle[i]]);
            const glm::dvec3 b(mesh.positions[triangle[(i + 1) % 3]]);
            const double along = isCorner ? 0.0 : 0.02 + 0.96 * double{random.unit()};
            rays.push_back(freeRay(origin, glm::normalize(a + along * (b - a) - glm::dvec3(origin))));
        }
    return rays;
}

// From a random point inside, where roundings decide which triangle is met. None leaks through an edge.
TEST_F(RaysTogether, AtEdgesAndVerticesFindTheSame) {
    const ClosedMesh meshes[] = {makeCube(), makeGriddedCube(16), displaced(makeIcosphere(3), 0.1f, 1)};
    size_t edgeRays = 0;
    size_t leaks = 0;
    for (const ClosedMesh& mesh : meshes)
        for (const Placement& placement : kPlacements) {
            const ClosedMesh there = placed(mesh, placement);
            const GpuScene gpuScene = upload(sceneOf(there));
            RayTracer tracer(device(), gpuScene);
            Random random(1);
            for (int round = 0; round < rounds(); ++round) {
                const auto seed = static_cast<uint32_t>(round);
                const glm::vec3 origin =
                    placement.centre() + 0.4f * placement.scale * random.unit() * random.direction();
                const std::vector<Ray> edges = towardsEdges(there, origin, false, random);
                EXPECT_EQ(differing(tracer, towardsEdges(there, origin, true, random), seed), 0u)
                    << placement.name();
                EXPECT_EQ(differing(tracer, edges, seed), 0u) << placement.name();
                for (const TracedHit& hit : tracer.closest(edges))
                    leaks += isSurface(hit.surface) ? 0 : 1;
                edgeRays += edges.size();
            }
        }
    EXPECT_EQ(leaks, 0u) << "of " << edgeRays << " rays at edges";
}

// Each of two triangles in one place is met at the same distance.
TEST_F(RaysTogether, AtCoincidentTrianglesFindTheSame) {
    SceneBuilder builder;
    for (int copy = 0; copy < 3; ++copy)
        builder.add(ball({0, 0, 0}, 1.0f), lambert(glm::vec3(0.5f)));
    const Scene scene = builder.camera(lookAt({0, 0, 3}, {0, 0, 0}, 0.7f)).build();
    const GpuScene gpuScene = upload(scene);
    RayTracer tracer(device(), gpuScene);
    for (int round = 0; round < rounds(); ++round) {
        const auto seed = static_cast<uint32_t>(round + 1);
        EXPECT_EQ(differing(tracer, makeCameraRays(scene.cameras.front(), 20000, seed), seed), 0u);
    }
}

} // namespace
} // namespace lavalight::test
