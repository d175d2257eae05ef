// Pieces of split triangles cover them, tightly, and are as many as were allowed.
#include "accel/presplit.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/random_numbers.h"

namespace lavalight::test {
namespace {

const Bounds kCube{glm::vec3(-1.0f), glm::vec3(1.0f)};

glm::vec3 randomPoint(Random& random) {
    return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

std::vector<Triangle> largeTriangles(uint32_t count) {
    Random random(1);
    std::vector<Triangle> triangles;
    for (uint32_t i = 0; i < count; ++i)
        triangles.push_back({randomPoint(random), randomPoint(random), randomPoint(random)});
    return triangles;
}

bool contains(const BuildBox& box, const glm::dvec3& p) {
    return glm::all(glm::lessThanEqual(glm::dvec3(box.lower), p)) &&
           glm::all(glm::lessThanEqual(p, glm::dvec3(box.upper)));
}

TEST(Presplit, PiecesCoverTheirTriangles) {
    const std::vector<Triangle> triangles = largeTriangles(300);
    const std::vector<Fragment> fragments = presplit(triangles, kCube, 10.0f);
    Random random(2);
    for (uint32_t id = 0; id < triangles.size(); ++id)
        for (int i = 0; i < 300; ++i) {
            const double s = i % 3 == 0 ? 1.0 : std::sqrt(random.unit()); // every third on an edge
            const double r = random.unit();
            const glm::dvec3 p = (1.0 - s) * glm::dvec3(triangles[id].v0) +
                                 s * (1.0 - r) * glm::dvec3(triangles[id].v1) +
                                 s * r * glm::dvec3(triangles[id].v2);
            EXPECT_TRUE(std::any_of(fragments.begin(), fragments.end(), [&](const Fragment& f) {
                return f.triangle == id && contains(f.box, p);
            }));
        }
}

TEST(Presplit, StaysWithinItsBudgetAndUsesMostOfIt) {
    const std::vector<Triangle> triangles = largeTriangles(1000);
    const size_t added = presplit(triangles, kCube, 2.0f).size() - triangles.size();
    EXPECT_LE(added, 2000u);
    EXPECT_GT(added, 1900u);
    EXPECT_EQ(presplit(triangles, kCube, 0.0f).size(), triangles.size());
}

TEST(Presplit, BoxesEndAtTheCutAndFitTheParts) {
    // Cut at x = 0, the middle of the scene, where the triangle is 2 high of its 4.
    const std::vector<Triangle> triangle{{{-2, 0, 0}, {2, 0, 0}, {-2, 4, 0}}};
    const std::vector<Fragment> fragments = presplit(triangle, {{-2, 0, 0}, {2, 4, 0}}, 1.0f);
    ASSERT_EQ(fragments.size(), 2u);
    EXPECT_NEAR(fragments[0].box.upper.x, 0.0f, 1e-6f);
    EXPECT_EQ(fragments[0].box.upper.y, 4.0f);
    EXPECT_NEAR(fragments[1].box.lower.x, 0.0f, 1e-6f);
    EXPECT_NEAR(fragments[1].box.upper.y, 2.0f, 1e-6f);
    EXPECT_EQ(fragments[1].box.upper.z, 0.0f); // flat stays flat
}

TEST(Presplit, CutsWhereTheSceneIsHalvedFirst) {
    // Crosses x = 0.5, where a quarter of the scene ends, and y = 0, its middle.
    const std::vector<Triangle> triangle{{{0.1f, -0.4f, 0}, {0.9f, -0.4f, 0.1f}, {0.1f, 0.4f, 0.2f}}};
    const std::vector<Fragment> fragments = presplit(triangle, kCube, 1.0f);
    ASSERT_EQ(fragments.size(), 2u);
    EXPECT_NEAR(fragments[0].box.upper.y, 0.0f, 1e-6f);
    EXPECT_NEAR(fragments[1].box.lower.y, 0.0f, 1e-6f);
}

TEST(Presplit, SplitsDiagonalTrianglesRatherThanThoseThatFillTheirBoxes) {
    const std::vector<Triangle> triangles{{{-1, -1, 0.1f}, {1, -1, 0.1f}, {-1, 1, 0.1f}},
                                          {{-1, -1, -1}, {1, 1, 1}, {1, 1, 0.9f}}};
    uint32_t flat = 0;
    uint32_t diagonal = 0;
    for (const Fragment& fragment : presplit(triangles, kCube, 5.0f))
        ++(fragment.triangle == 0 ? flat : diagonal);
    EXPECT_GT(diagonal, flat + 1);
}

TEST(Presplit, TakesScenesWithoutExtent) {
    const std::vector<Triangle> points(10, Triangle{glm::vec3(3), glm::vec3(3), glm::vec3(3)});
    EXPECT_EQ(presplit(points, {glm::vec3(3), glm::vec3(3)}, 5.0f).size(), 10u);
}

} // namespace
} // namespace lavalight::test
