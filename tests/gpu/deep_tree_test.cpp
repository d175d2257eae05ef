// Rays that leave more siblings waiting than the traversal's registers hold lose none of them.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "accel/bvh.h"
#include "device_scene/gpu_scene.h"
#include "inspect/embree_oracle.h"
#include "inspect/ray_sets.h"
#include "inspect/ray_tracer.h"
#include "support/closed_meshes.h"
#include "support/random_numbers.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

void addTriangle(ClosedMesh& mesh, const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {v0, v1, v2});
    mesh.triangles.push_back(glm::uvec3(first) + glm::uvec3(0, 1, 2));
}

// Small triangles around the x axis at 1, 1/2, 1/4 ... from the origin: the tree nests as deep as there are
// powers, and a ray from the origin along the axis enters the box of the larger half at each level while the
// smaller one, nearer, comes first.
ClosedMesh halvingRow(int powers, int perPower) {
    ClosedMesh mesh;
    Random random(1);
    for (int power = 0; power < powers; ++power)
        for (int i = 0; i < perPower; ++i) {
            const float scale = std::ldexp(1.0f, -power);
            const glm::vec3 v = scale * glm::vec3(random.between(0.6f, 1.0f), random.between(-0.3f, 0.3f),
                                                  random.between(-0.3f, 0.3f));
            addTriangle(mesh, v, v + 0.04f * scale * random.direction(),
                        v + 0.04f * scale * random.direction());
        }
    return mesh;
}

class DeepTreeTest : public DeviceTest {};

TEST_F(DeepTreeTest, IsSearchedToItsEnd) {
    const Scene scene = sceneOf(halvingRow(32, 40));
    const std::vector<Triangle> triangles = sceneTriangles(scene);
    ASSERT_GT(buildBvh(triangles).levels, 16u); // twice the entries that stay in registers
    std::vector<Ray> rays;
    std::vector<OracleRay> oracleRays;
    Random random(2);
    for (int i = 0; i < 100000; ++i) {
        const glm::vec3 towards(1.0f, random.between(-0.3f, 0.3f), random.between(-0.3f, 0.3f));
        rays.push_back(freeRay(glm::vec3(0.0f), glm::normalize(towards)));
        oracleRays.push_back({rays.back().origin, rays.back().direction});
    }
    const GpuScene gpuScene(device(), packScene(scene));
    const std::vector<TracedHit> ours = RayTracer(device(), gpuScene).closest(rays);
    const std::vector<OracleHit> theirs =
        EmbreeOracle(triangles, EmbreeOracle::Traversal::robust).closest(oracleRays);
    size_t late = 0;
    size_t different = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        late += std::isfinite(theirs[i].t) && theirs[i].t > 0.25f ? 1 : 0;
        different +=
            (ours[i].t == theirs[i].t || std::abs(ours[i].t - theirs[i].t) <= 1e-4f * theirs[i].t) ? 0 : 1;
    }
    EXPECT_GT(late, rays.size() / 100); // found after all that is nearer was passed
    EXPECT_LE(different, 2u);
}

} // namespace
} // namespace lavalight::test
