// The ground below a model.
#include "scene/ground.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace lavalight {
namespace {

// A model of radius 5 that stands 2 m above the origin, off the middle.
Scene model() {
    Scene scene;
    scene.materials.resize(1);
    scene.bounds = {{7, 2, -3}, {13, 10, -3}};
    return scene;
}

TEST(Ground, LiesRightBelowTheModel) {
    EXPECT_LT(groundHeight(model().bounds), 2.0f);
    EXPECT_GT(groundHeight(model().bounds), 2.0f - 5.0f * 2e-4f);
    EXPECT_LT(groundHeight(Bounds()), 0.0f); // a model without size
}

TEST(Ground, IsAFlatSquareAroundTheModelThatFacesUp) {
    Scene scene = model();
    addGround(scene, 1.5f, {0.2f, 0.3f, 0.4f});
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& ground = scene.meshes.front();
    EXPECT_EQ(scene.materials.at(ground.material).baseColor, glm::vec3(0.2f, 0.3f, 0.4f));
    EXPECT_EQ(scene.materials.at(ground.material).specular, 0.0f);
    double area = 0.0;
    double farthest = 0.0;
    for (const glm::vec3& p : ground.positions) {
        EXPECT_EQ(p.y, 1.5f);
        farthest = std::max(farthest, double{p.x} - 10.0);
    }
    for (const glm::uvec3& t : ground.triangles) {
        const glm::dvec3 a(ground.positions.at(t.x));
        const glm::dvec3 b(ground.positions.at(t.y));
        const glm::dvec3 c(ground.positions.at(t.z));
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        EXPECT_GT(normal.y, 0.0);
        area += 0.5 * normal.y;
    }
    EXPECT_GT(farthest, 1000.0 * 5.0);
    EXPECT_NEAR(area, 4.0 * farthest * farthest, 1e-6 * area); // no gap, nothing twice
}

// What frames the model or weighs lights does not see the ground; what has to leave the scene does.
TEST(Ground, LeavesTheBoundsAndIsWithinReach) {
    Scene scene = model();
    addGround(scene, 1.5f, glm::vec3(0.5f));
    EXPECT_EQ(scene.bounds.lower, model().bounds.lower);
    EXPECT_EQ(scene.bounds.upper, model().bounds.upper);
    for (const glm::vec3& p : scene.meshes.front().positions)
        EXPECT_LE(glm::distance(p, scene.bounds.center()), scene.reach);
}

} // namespace
} // namespace lavalight
