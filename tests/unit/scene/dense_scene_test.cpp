// The bench scene has the size asked for, is always the same, and is sound geometry.
#include "scene/procedural/dense_scene.h"

#include <cstring>

#include <gtest/gtest.h>

namespace lavalight::test {
namespace {

TEST(DenseScene, HasTheTriangleCountWithinOnePerCent) {
    for (const uint32_t count : {5000u, 20000u, 300000u, 1000000u})
        EXPECT_NEAR(static_cast<double>(makeDenseScene(count).triangleCount()), count, 0.01 * count);
}

// Hash of every position: FNV-1a.
TEST(DenseScene, HasTheSameBitsEverywhere) {
#if !defined(__x86_64__) || defined(__FMA__)
    GTEST_SKIP() << "this compiler may contract products and sums, which changes last bits";
#endif
    uint64_t hash = 14695981039346656037u;
    for (const Mesh& mesh : makeDenseScene(20000).meshes)
        for (const glm::vec3& p : mesh.positions)
            for (int i = 0; i < 3; ++i) {
                uint32_t bits = 0;
                std::memcpy(&bits, &p[i], sizeof bits);
                hash = (hash ^ bits) * 1099511628211u;
            }
    EXPECT_EQ(hash, 8061033949565391232u);
}

TEST(DenseScene, HasValidIndicesAndUnitNormals) {
    const Scene scene = makeDenseScene(20000);
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(mesh.material, scene.materials.size());
        for (const glm::uvec3& t : mesh.triangles)
            ASSERT_TRUE(glm::all(glm::lessThan(t, glm::uvec3(static_cast<uint32_t>(mesh.positions.size())))));
        for (const glm::vec3& n : mesh.normals)
            ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f);
    }
}

// Sphere centres are not stored; a closed mesh whose faces point outward encloses a positive volume. One
// folded onto itself, whose layers coincide, encloses almost none.
TEST(DenseScene, HasBlobsThatFaceOutward) {
    uint32_t blobs = 0;
    for (const Mesh& mesh : makeDenseScene(20000).meshes) {
        if (!mesh.name.starts_with("blob"))
            continue;
        double volume = 0.0;
        for (const glm::uvec3& t : mesh.triangles)
            volume += glm::dot(glm::dvec3(mesh.positions[t.x]),
                               glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
        glm::dvec3 lower(mesh.positions[0]), upper(mesh.positions[0]);
        for (const glm::vec3& p : mesh.positions) {
            lower = glm::min(lower, glm::dvec3(p));
            upper = glm::max(upper, glm::dvec3(p));
        }
        const glm::dvec3 size = upper - lower;
        EXPECT_GT(volume / 6.0, 0.1 * size.x * size.y * size.z) << mesh.name;
        ++blobs;
    }
    EXPECT_GT(blobs, 30u);
}

TEST(DenseScene, HasGroundThatFacesUpAndAPanelThatFacesDown) {
    const Scene scene = makeDenseScene(20000);
    const auto normal = [](const Mesh& mesh) {
        const glm::uvec3 t = mesh.triangles[0];
        const glm::vec3 v0 = mesh.positions[t.x];
        return glm::cross(mesh.positions[t.y] - v0, mesh.positions[t.z] - v0);
    };
    EXPECT_GT(normal(scene.meshes[0]).y, 0.0f);
    EXPECT_LT(normal(scene.meshes[1]).y, 0.0f);
    EXPECT_GT(scene.materials[scene.meshes[1].material].emission.g, 0.0f);
}

} // namespace
} // namespace lavalight::test
