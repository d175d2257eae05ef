// Triangles whose smooth surface another surface pierces or covers are found, and no others.
#include "accel/lift_clearance.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/closed_meshes.h"
#include "support/random_numbers.h"
#include "support/scene_builder.h"

namespace lavalight::test {
namespace {

const glm::vec3 kOrigin(0.0f);

// The unit sphere in 320 triangles, whose edges are up to 0.33 m long.
Shape sphere() {
    const ClosedMesh mesh = makeIcosphere(2);
    return {mesh.positions, mesh.triangles};
}

SceneBuilder smoothSphere() {
    return SceneBuilder().addSmooth(sphere(), kOrigin, lambert(glm::vec3(1.0f)));
}

std::vector<bool> crowdedOf(const Scene& scene) {
    return crowdedLifts(scene, sceneTriangles(scene));
}

size_t countOf(const std::vector<bool>& marks) {
    return static_cast<size_t>(std::ranges::count(marks, true));
}

Shape shifted(Shape shape, const glm::vec3& by) {
    for (glm::vec3& p : shape.positions)
        p += by;
    return shape;
}

TEST(CrowdedLifts, ASphereByItselfIsFree) {
    EXPECT_EQ(countOf(crowdedOf(smoothSphere().build())), 0u);
}

TEST(CrowdedLifts, FlatScenesAreNotSearched) {
    const Scene scene = SceneBuilder()
                            .add(sphere(), lambert(glm::vec3(1.0f)))
                            .add(cube(kOrigin, 0.9f), lambert(glm::vec3(1.0f)))
                            .build();
    EXPECT_TRUE(crowdedOf(scene).empty());
}

// How far above a point of the sphere, with barycentrics b, its smooth surface lies (Hanika 2021, chapter 4).
glm::vec3 liftOf(const Triangle& t, const glm::vec3& b) {
    const glm::vec3 p = b.x * t.v0 + b.y * t.v1 + b.z * t.v2;
    const auto toCorner = [&](const glm::vec3& corner) { // the normal of a unit sphere is the point itself
        return std::max(0.0f, glm::dot(corner - p, corner)) * corner;
    };
    return b.x * toCorner(t.v0) + b.y * toCorner(t.v1) + b.z * toCorner(t.v2);
}

// Whether a floor at that height parts one of 64 points from the smooth surface above it.
bool partsLift(const Triangle& t, float height, Random& random) {
    for (int i = 0; i < 64; ++i) {
        const float r = std::sqrt(random.between(0, 1));
        const float s = random.between(0, 1);
        const glm::vec3 b(1 - r, r * (1 - s), r * s);
        const float y = b.x * t.v0.y + b.y * t.v1.y + b.z * t.v2.y;
        if ((y > height) != (y + liftOf(t, b).y > height))
            return true;
    }
    return false;
}

TEST(CrowdedLifts, OnAFloorTheTrianglesAroundTheContactAreMarked) {
    for (const float height : {-1.0f, -0.99f, -0.7f, 0.2f}) {
        SCOPED_TRACE(height);
        const Scene scene =
            smoothSphere()
                .add(rectangle({0, height, 0}, {0, 0, 3}, {3, 0, 0}), lambert(glm::vec3(1.0f)))
                .build();
        const std::vector<Triangle> triangles = sceneTriangles(scene);
        const std::vector<bool> crowded = crowdedLifts(scene, triangles);
        ASSERT_EQ(crowded.size(), 322u);
        Random random(1);
        for (size_t id = 0; id < 320; ++id) {
            const Triangle& t = triangles[id];
            EXPECT_TRUE(crowded[id] || !partsLift(t, height, random)) << id;
            const float lowest = std::min({t.v0.y, t.v1.y, t.v2.y});
            const float highest = std::max({t.v0.y, t.v1.y, t.v2.y});
            EXPECT_FALSE(crowded[id] && (lowest > height + 0.1f || highest < height - 0.1f)) << id;
        }
        EXPECT_GT(countOf(crowded), 0u);
    }
}

// A pin through the middle of one triangle.
TEST(CrowdedLifts, OneTriangleIsMarkedWhereAPinPiercesIt) {
    const Shape ball = sphere();
    const glm::uvec3 t = ball.triangles[100];
    const glm::vec3 middle = (ball.positions[t.x] + ball.positions[t.y] + ball.positions[t.z]) / 3.0f;
    const glm::vec3 wide = 0.002f * glm::normalize(glm::cross(middle, glm::vec3(1, 2, 3)));
    const Scene scene =
        smoothSphere().add(rectangle(middle, 0.1f * middle, wide), lambert(glm::vec3(1.0f))).build();
    const std::vector<bool> crowded = crowdedOf(scene);
    EXPECT_TRUE(crowded[100]);
    EXPECT_EQ(countOf(crowded), 1u);
}

// From inside a hollow sphere its smooth surface lies behind the mesh.
TEST(CrowdedLifts, BehindAHollowSurfaceTheSameAreMarked) {
    const Shape floor = rectangle({0, -0.99f, 0}, {0, 0, 3}, {3, 0, 0});
    const Scene full = smoothSphere().add(floor, lambert(glm::vec3(1.0f))).build();
    Scene hollow = SceneBuilder()
                       .addSmooth(insideOut(sphere()), kOrigin, lambert(glm::vec3(1.0f)))
                       .add(floor, lambert(glm::vec3(1.0f)))
                       .build();
    for (glm::vec3& n : hollow.meshes[0].normals)
        n = -n;
    EXPECT_EQ(crowdedOf(hollow), crowdedOf(full));
    EXPECT_GT(countOf(crowdedOf(hollow)), 0u);
}

// Around the sphere, touching nothing: the flat faces of the shell lie above all lifts, or amid them.
// it.
TEST(CrowdedLifts, AShellAboveTheSmoothSurfaceIsNotInItsWay) {
    const auto inside = [](float scale) {
        Shape shell = sphere();
        for (glm::vec3& p : shell.positions)
            p *= scale;
        return countOf(crowdedOf(smoothSphere().add(shell, lambert(glm::vec3(1.0f))).build()));
    };
    EXPECT_EQ(inside(1.06f), 0u);
    EXPECT_EQ(inside(1.005f), 320u);
}

// Ones that coincide are one surface (a liquid that touches its glass).
TEST(CrowdedLifts, ACoincidentMeshIsNotInTheWay) {
    const Scene scene =
        smoothSphere().addSmooth(insideOut(sphere()), kOrigin, lambert(glm::vec3(1.0f))).build();
    EXPECT_EQ(countOf(crowdedOf(scene)), 0u);
}

// Moved 1 km, the pin is still found, and nothing else.
TEST(CrowdedLifts, FarFromTheOriginTheSameAreMarked) {
    const glm::vec3 far(1000.0f, -2000.0f, 500.0f);
    const Shape floor = rectangle({0, -0.99f, 0}, {0, 0, 3}, {3, 0, 0});
    const Material white = lambert(glm::vec3(1.0f));
    const Scene near = smoothSphere().add(floor, white).build();
    const Scene there =
        SceneBuilder().addSmooth(shifted(sphere(), far), far, white).add(shifted(floor, far), white).build();
    EXPECT_EQ(crowdedOf(near), crowdedOf(there));
}

} // namespace
} // namespace lavalight::test
