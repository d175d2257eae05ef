// Rays that the host traces together find what each finds alone, whichever others are beside them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "device_scene/gpu_scene.h"
#include "hosted/host_rays.h"
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

class RaysTogether : public DeviceTest, public testing::WithParamInterface<AcceleratorKind> {
  protected:
    void SetUp() override {
        if (!device().description().sharesMemory)
            GTEST_SKIP() << "the host does not reach the device's memory";
    }
    [[nodiscard]] GpuScene upload(const Scene& scene) {
        const Lights lights = collectLights(scene, glm::vec3(0.0f), LightSelection::power);
        return {device(), packScene(scene, lights, GetParam())};
    }
    // How many of the rays find something else together than alone, in the order given and in another.
    [[nodiscard]] static size_t differing(RayTracer& tracer, std::vector<Ray> rays, uint32_t seed) {
        size_t count = 0;
        for (int order = 0; order < 2; ++order) {
            const std::vector<TracedHit> alone = tracer.closest(rays);
            const std::vector<TracedHit> together = tracer.closest(rays, Likeness::alike);
            for (size_t i = 0; i < rays.size(); ++i)
                count += alone[i].t != together[i].t || !isSameSurface(alone[i].surface, together[i].surface)
                             ? 1
                             : 0;
            std::shuffle(rays.begin(), rays.end(), std::mt19937(seed));
        }
        return count;
    }
};

TEST_P(RaysTogether, OfCamerasAndBouncesFindTheSame) {
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
TEST_P(RaysTogether, AtEdgesAndVerticesFindTheSame) {
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
TEST_P(RaysTogether, AtCoincidentTrianglesFindTheSame) {
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

// Shells in one another, two of them in one place: one lets rays through by chance, one where the alpha of
// its vertices is low, one both from behind alone.
Scene makeShells() {
    Material blended = lambert(glm::vec3(0.5f));
    blended.alphaMode = AlphaMode::blend;
    blended.alpha = 0.4f;
    blended.doubleSided = true;
    Material cut = blended;
    cut.alphaMode = AlphaMode::mask;
    cut.alpha = 1.0f;
    Material culled = blended;
    culled.doubleSided = false;
    SceneBuilder builder;
    builder.add(ball({0, 0, 0}, 1.0f), blended).add(ball({0, 0, 0}, 1.0f), culled);
    builder.add(ball({0, 0, 0}, 0.8f), cut).add(ball({0, 0, 0}, 0.5f), lambert(glm::vec3(0.5f)));
    Scene scene = builder.camera(lookAt({0, 0, 3}, {0, 0, 0}, 0.7f)).build();
    Random random(3);
    for (size_t i = 0; i < scene.meshes[2].positions.size(); ++i)
        scene.meshes[2].colors.emplace_back(1.0f, 1.0f, 1.0f, random.unit());
    return scene;
}

struct SlotAndRay {
    uint32_t slot;
    Ray ray;
};

// Traces rays that know their slots, which chance depends on.
class SlotTracer {
  public:
    SlotTracer(const HostScene& scene, uint32_t seed, size_t slots)
        : host_(scene, frame(seed), range(slots)) {}

    std::vector<Hit> alone(uint32_t bounce, std::span<const SlotAndRay> rays) {
        std::vector<Hit> hits;
        for (const SlotAndRay& one : rays)
            hits.push_back(trace(bounce, Likeness::unlike, std::span(&one, 1))[0]);
        return hits;
    }
    std::vector<Hit> together(uint32_t bounce, std::span<const SlotAndRay> rays) {
        return trace(bounce, Likeness::alike, rays);
    }

  private:
    static FrameParameters frame(uint32_t seed) {
        FrameParameters frame{};
        frame.imageWidth = 512;
        frame.seed = seed;
        frame.clipDepth = std::numeric_limits<float>::infinity();
        frame.cameraForward = {0.0f, 0.0f, -1.0f};
        return frame;
    }
    static WaveRange range(size_t slots) {
        WaveRange range{};
        range.pixelCount = static_cast<uint32_t>(slots);
        range.sampleCount = 1;
        return range;
    }

    std::vector<Hit> trace(uint32_t bounce, Likeness likeness, std::span<const SlotAndRay> rays) {
        std::vector<uint32_t> slots;
        std::vector<Ray> copies;
        for (const SlotAndRay& one : rays) {
            slots.push_back(one.slot);
            copies.push_back(one.ray);
        }
        std::vector<HostHit> met(rays.size());
        host_.trace(bounce, likeness, slots, copies, met);
        std::vector<Hit> hits(rays.size());
        std::ranges::transform(met, hits.begin(), &HostHit::hit);
        return hits;
    }

    HostRays host_;
};

size_t differences(const std::vector<Hit>& a, const std::vector<Hit>& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const bool isSame =
            a[i].t == b[i].t &&
            (std::isinf(a[i].t) || (a[i].record == b[i].record && a[i].barycentrics == b[i].barycentrics));
        count += isSame ? 0 : 1;
    }
    return count;
}

// The host's own tree asks about triangles with alpha and about backs, Embree about every triangle.
TEST_P(RaysTogether, ThroughAlphaAndCulledFacesFindWhatTheOtherTreeFinds) {
    constexpr size_t kRays = 100'000;
    const Scene scene = makeShells();
    const Lights lights = collectLights(scene, glm::vec3(0.0f), LightSelection::power);
    const GpuScene one = upload(scene);
    const GpuScene other(device(), packScene(scene, lights,
                                             GetParam() == AcceleratorKind::bvh16 ? AcceleratorKind::embree
                                                                                  : AcceleratorKind::bvh16));
    constexpr SceneFeatures kFeatures = kFeatureAlpha | kFeatureVertexColors;
    const std::vector<Ray> camera = makeCameraRays(scene.cameras.front(), kRays, 1);
    std::vector<SlotAndRay> rays;
    for (uint32_t slot = 0; slot < camera.size(); ++slot)
        rays.push_back({slot, camera[slot]});
    for (const uint32_t bounce : {0u, 1u})
        EXPECT_LE(differences(SlotTracer(hostScene(one, kFeatures), 1, kRays).together(bounce, rays),
                              SlotTracer(hostScene(other, kFeatures), 1, kRays).alone(bounce, rays)),
                  2u);
}

// Where chance, alpha and culling decide what a ray meets.
TEST_P(RaysTogether, ThroughAlphaAndCulledFacesFindTheSame) {
    constexpr size_t kRays = 100'000;
    const Scene scene = makeShells();
    const GpuScene gpuScene = upload(scene);
    const HostScene hosted = hostScene(gpuScene, kFeatureAlpha | kFeatureVertexColors);
    Random random(4);
    for (int round = 0; round < rounds(); ++round) {
        const auto seed = static_cast<uint32_t>(round + 1);
        const std::vector<Ray> camera = makeCameraRays(scene.cameras.front(), kRays, seed);
        SlotTracer tracer(hosted, seed, camera.size());
        std::vector<SlotAndRay> fromCamera;
        std::vector<SlotAndRay> fromInside;
        for (uint32_t slot = 0; slot < camera.size(); ++slot) {
            fromCamera.push_back({slot, camera[slot]});
            fromInside.push_back(
                {slot, freeRay(0.9f * random.unit() * random.direction(), random.direction())});
        }
        for (const uint32_t bounce : {0u, 1u})
            for (std::vector<SlotAndRay>* rays : {&fromCamera, &fromInside}) {
                if (bounce == 0 && rays == &fromInside)
                    continue; // no camera looks backwards
                const std::vector<Hit> alone = tracer.alone(bounce, *rays);
                EXPECT_EQ(differences(alone, tracer.together(bounce, *rays)), 0u);
                const std::vector<Hit> byOtherChance =
                    SlotTracer(hosted, seed + 1000, camera.size()).alone(bounce, *rays);
                EXPECT_GT(differences(alone, byOtherChance), camera.size() / 20)
                    << "alpha lets nothing through";
                std::shuffle(rays->begin(), rays->end(), std::mt19937(seed));
                EXPECT_EQ(differences(tracer.alone(bounce, *rays), tracer.together(bounce, *rays)), 0u);
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Trees, RaysTogether,
                         testing::Values(AcceleratorKind::bvh16, AcceleratorKind::embree),
                         [](const auto& tree) {
                             return tree.param == AcceleratorKind::bvh16 ? "bvh16" : "embree";
                         });

} // namespace
} // namespace lavalight::test
