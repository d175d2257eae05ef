// Triangles whose smooth surface another surface pierces or covers are found, and no others.
#include "accel/lift_clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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

// A smooth mesh of one triangle, with normals of its own.
Scene oneTriangle(const Triangle& t, const std::array<glm::vec3, 3>& normals) {
    Scene scene = SceneBuilder().add({{t.v0, t.v1, t.v2}, {{0, 1, 2}}}, lambert(glm::vec3(1.0f))).build();
    scene.meshes[0].normals.assign(normals.begin(), normals.end());
    return scene;
}

// Rounding is no lift, and corners of a cube stand for nothing smooth (shaders/lib/math/smooth_surface.glsl).
TEST(CrowdedLifts, SmoothMeshesThatLiftNothingAreNotSearched) {
    const Triangle flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const float tilt = 5e-6f;
    EXPECT_TRUE(
        crowdedOf(oneTriangle(flat, {glm::vec3(-tilt, -tilt, 1), {tilt, 0, 1}, {0, tilt, 1}})).empty());
    Shape box = cube(kOrigin, 1.0f);
    EXPECT_TRUE(crowdedOf(SceneBuilder().addSmooth(box, kOrigin, lambert(glm::vec3(1.0f))).build()).empty());
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
    ASSERT_EQ(crowded.size(), 322u);
    EXPECT_TRUE(crowded[100]);
    EXPECT_EQ(countOf(crowded), 1u);
}

// A crumb over the middle of one triangle.
TEST(CrowdedLifts, WhatHoversBelowTheSmoothSurfaceIsInTheWayAndWhatHoversAboveIsNot) {
    const Triangle t = sceneTriangles(smoothSphere().build())[100];
    const glm::vec3 middle = (t.v0 + t.v1 + t.v2) / 3.0f;
    const glm::vec3 wide = 0.002f * glm::normalize(t.v1 - t.v0);
    const glm::vec3 deep = 0.002f * glm::normalize(glm::cross(t.v1 - t.v0, middle));
    const auto marksAt = [&](float share) {
        const glm::vec3 place = middle + share * liftOf(t, glm::vec3(1.0f / 3.0f));
        return crowdedOf(smoothSphere().add(rectangle(place, wide, deep), lambert(glm::vec3(1.0f))).build());
    };
    EXPECT_TRUE(marksAt(0.95f).at(100));
    EXPECT_EQ(countOf(marksAt(0.95f)), 1u);
    EXPECT_EQ(countOf(marksAt(1.3f)), 0u);
}

// A face of an icosahedron: its smooth surface leans over the edges by a twelfth of the radius.
TEST(CrowdedLifts, WhatStandsBesideATriangleIsInTheWayWhereItsSmoothSurfaceLeansOut) {
    const ClosedMesh mesh = makeIcosphere(0);
    const glm::uvec3 ids = mesh.triangles[0];
    const Triangle t{mesh.positions[ids.x], mesh.positions[ids.y], mesh.positions[ids.z]};
    const glm::vec3 lift = liftOf(t, {0.5f, 0.5f, 0.0f});
    const glm::vec3 edge = glm::normalize(t.v1 - t.v0);
    for (const float share : {0.5f, 1.5f}) {
        const Shape crumb =
            rectangle(0.5f * (t.v0 + t.v1) + share * lift, 0.01f * edge, 0.01f * glm::normalize(lift));
        Scene scene = SceneBuilder()
                          .addSmooth({{t.v0, t.v1, t.v2}, {{0, 1, 2}}}, kOrigin, lambert(glm::vec3(1.0f)))
                          .add(crumb, lambert(glm::vec3(1.0f)))
                          .build();
        const std::vector<bool> crowded = crowdedOf(scene);
        ASSERT_EQ(crowded.size(), 3u);
        EXPECT_EQ(crowded[0], share < 1.0f) << share;
    }
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

// A hyperbolic paraboloid: beyond some edges of each triangle the next one rises.
TEST(CrowdedLifts, ASaddleByItselfIsFree) {
    Shape saddle;
    std::vector<glm::vec3> normals;
    constexpr uint32_t kCells = 8;
    for (uint32_t y = 0; y <= kCells; ++y)
        for (uint32_t x = 0; x <= kCells; ++x) {
            const glm::vec2 p = 2.0f * glm::vec2(x, y) / static_cast<float>(kCells) - 1.0f;
            saddle.positions.emplace_back(p, 0.5f * (p.x * p.x - p.y * p.y));
            normals.push_back(glm::normalize(glm::vec3(-p.x, p.y, 1.0f)));
            const uint32_t i = y * (kCells + 1) + x;
            if (x < kCells && y < kCells) {
                saddle.triangles.emplace_back(i, i + 1, i + kCells + 2);
                saddle.triangles.emplace_back(i, i + kCells + 2, i + kCells + 1);
            }
        }
    Scene scene = SceneBuilder().add(saddle, lambert(glm::vec3(1.0f))).build();
    scene.meshes[0].normals = normals;
    const std::vector<bool> crowded = crowdedOf(scene);
    EXPECT_EQ(crowded.size(), 2u * kCells * kCells);
    EXPECT_EQ(countOf(crowded), 0u);
}

// The upper half of the sphere, with a flat lid that touches its rim.
TEST(CrowdedLifts, ALidThatTouchesTheRimFromBelowIsNotInTheWay) {
    constexpr uint32_t kSides = 16;
    Shape dome;
    Shape lid;
    dome.positions.emplace_back(0, 1, 0);
    for (uint32_t ring = 1; ring <= 4; ++ring)
        for (uint32_t i = 0; i < kSides; ++i) {
            const float theta = 0.392699f * static_cast<float>(ring);
            const float phi = 0.392699f * static_cast<float>(i);
            dome.positions.emplace_back(std::sin(theta) * std::cos(phi), ring < 4 ? std::cos(theta) : 0.0f,
                                        -std::sin(theta) * std::sin(phi));
        }
    lid.positions = {kOrigin};
    lid.positions.insert(lid.positions.end(), dome.positions.end() - kSides, dome.positions.end());
    for (uint32_t i = 0; i < kSides; ++i) {
        const uint32_t next = (i + 1) % kSides;
        dome.triangles.emplace_back(0, 1 + i, 1 + next);
        for (uint32_t ring = 0; ring < 3; ++ring) {
            const uint32_t first = 1 + ring * kSides;
            dome.triangles.emplace_back(first + i, first + kSides + i, first + kSides + next);
            dome.triangles.emplace_back(first + i, first + kSides + next, first + next);
        }
        lid.triangles.emplace_back(0, 1 + next, 1 + i);
    }
    const Scene scene = SceneBuilder()
                            .addSmooth(dome, kOrigin, lambert(glm::vec3(1.0f)))
                            .add(lid, lambert(glm::vec3(1.0f)))
                            .build();
    const std::vector<bool> crowded = crowdedOf(scene);
    EXPECT_EQ(crowded.size(), 8u * kSides);
    EXPECT_EQ(countOf(crowded), 0u);
}

// A fin that starts from a vertex of the sphere, across the normal there.
TEST(CrowdedLifts, ACreaseInOneMeshEndsItsSmoothSurface) {
    Scene scene = smoothSphere().build();
    Mesh& mesh = scene.meshes[0];
    const glm::uvec3 t = mesh.triangles[100];
    const glm::vec3 root = mesh.positions[t.x];
    const glm::vec3 middle = (root + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
    const glm::vec3 across = glm::normalize(glm::cross(root, middle));
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : {root, middle, 1.2f * root}) {
        mesh.positions.push_back(p);
        mesh.normals.push_back(across);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    const std::vector<bool> crowded = crowdedOf(scene);
    ASSERT_EQ(crowded.size(), 321u);
    EXPECT_TRUE(crowded[100]);
    EXPECT_FALSE(crowded[320]) << "the fin itself is flat";
}

// Around the sphere, touching nothing: the flat faces of the shell lie above all lifts, or amid them.
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

// Normals alike do not make one surface of two.
TEST(CrowdedLifts, ASmoothShellAmidTheLiftsIsInTheWay) {
    Shape shell = sphere();
    for (glm::vec3& p : shell.positions)
        p *= 1.005f;
    const std::vector<bool> crowded =
        crowdedOf(smoothSphere().addSmooth(shell, kOrigin, lambert(glm::vec3(1.0f))).build());
    ASSERT_EQ(crowded.size(), 640u);
    EXPECT_EQ(std::count(crowded.begin(), crowded.begin() + 320, true), 320);
    EXPECT_EQ(std::count(crowded.begin() + 320, crowded.end(), true), 0);
}

// Meshes that coincide are one surface (a liquid that touches its glass).
TEST(CrowdedLifts, ACoincidentMeshIsNotInTheWay) {
    const Scene scene =
        smoothSphere().addSmooth(insideOut(sphere()), kOrigin, lambert(glm::vec3(1.0f))).build();
    EXPECT_EQ(countOf(crowdedOf(scene)), 0u);
}

// Both stand kilometres away from the origin.
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
