// The tree finds every triangle, its boxes are never too small, and no input makes it fail or grow too deep.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "scene/procedural/dense_scene.h"
#include "shared/triangle.h"
#include "support/bvh_walk.h"
#include "support/other_trees.h"
#include "support/random_numbers.h"
#include "support/scattered_triangles.h"

namespace lavalight::test {
namespace {

bool sameTree(const Bvh& a, const Bvh& b) {
    return a.nodes.size() == b.nodes.size() && a.leafTriangles == b.leafTriangles &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

std::set<uint32_t> reachable(const Bvh& bvh) {
    std::set<uint32_t> ids;
    forEachSlot(bvh, [&](uint32_t node, uint32_t slot, uint32_t) {
        if (const uint32_t reference = childReference(bvh.nodes[node], slot); isLeaf(reference))
            for (const uint32_t id : leafOf(bvh, reference))
                ids.insert(id);
    });
    return ids;
}

// What every tree owes, whatever the input.
void expectSound(const Bvh& bvh, size_t triangles) {
    EXPECT_EQ(reachable(bvh).size(), triangles);
    EXPECT_LE(bvh.levels, kMaxBvhLevels);
    forEachSlot(bvh, [&](uint32_t node, uint32_t slot, uint32_t) {
        const uint32_t reference = childReference(bvh.nodes[node], slot);
        const bool isEmpty = isLeaf(reference) && leafOf(bvh, reference).empty();
        EXPECT_EQ(childBox(bvh.nodes[node], slot).isEmpty(), isEmpty);
    });
    uint32_t levels = 0;
    forEachSlot(bvh, [&](uint32_t, uint32_t, uint32_t level) { levels = std::max(levels, level); });
    EXPECT_EQ(bvh.levels, triangles ? levels : 0);
}

TEST(Bvh, FindsTheSameClosestHitsAsBruteForce) {
    for (const float size : {0.2f, 1.5f}) {
        const std::vector<Triangle> triangles = scatteredTriangles(400, size, 1);
        const Bvh bvh = buildBvh(triangles);
        Random random(2);
        uint32_t hits = 0;
        for (int i = 0; i < 4000; ++i) {
            const OracleRay ray{randomPoint(random, 1.5f), random.direction()};
            const WalkHit expected = closestOfAll(triangles, ray);
            EXPECT_EQ(closestInTree(bvh, triangles, ray), expected);
            hits += std::isfinite(expected.t);
        }
        EXPECT_GT(hits, 100u);
    }
}

// Each triangle is there three times.
TEST(Bvh, OfAnyBuilderFindsTheLowestOfTrianglesInOnePlace) {
    std::vector<Triangle> triangles = scatteredTriangles(200, 1.0f, 3);
    for (int copy = 0; copy < 2; ++copy)
        triangles.insert(triangles.end(), triangles.begin(), triangles.begin() + 200);
    const Bvh trees[] = {buildBvh(triangles), medianBvh(triangles), withLeavesReversed(buildBvh(triangles))};
    EXPECT_FALSE(sameTree(trees[0], trees[1]));
    EXPECT_FALSE(sameTree(trees[0], trees[2]));
    Random random(4);
    uint32_t hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const OracleRay ray{randomPoint(random, 1.5f), random.direction()};
        for (const Bvh& tree : trees) {
            const WalkHit hit = closestInTree(tree, triangles, ray);
            EXPECT_EQ(hit, closestOfAll(triangles, ray));
            hits += hit.triangle < 200;
            EXPECT_TRUE(hit.triangle < 200 || std::isinf(hit.t));
        }
    }
    EXPECT_GT(hits, 300u);
}

TEST(Bvh, FindsWhatEmbreeFindsOnTheDenseScene) {
    const std::vector<Triangle> triangles = sceneTriangles(makeDenseScene(20000));
    const Bvh bvh = buildBvh(triangles);
    Random random(3);
    std::vector<OracleRay> rays;
    for (int i = 0; i < 20000; ++i)
        rays.push_back({randomPoint(random, 4.0f), random.direction()});
    const std::vector<OracleHit> oracle =
        EmbreeOracle(triangles, EmbreeOracle::Traversal::robust).closest(rays);
    uint32_t hits = 0;
    uint32_t differing = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const double t = closestInTree(bvh, triangles, rays[i]).t;
        hits += std::isfinite(t);
        // Embree computes in float: grazed triangles are off by more than the tolerance, edges fall to either
        // side.
        differing += std::isfinite(t) ? !(std::abs(oracle[i].t - t) <= 1e-4 * t) : std::isfinite(oracle[i].t);
    }
    EXPECT_GT(hits, 5000u);
    EXPECT_LE(differing, 3u);
}

TEST(Bvh, EveryPointOfATriangleLiesInALeafBoxThatListsIt) {
    for (const float size : {0.05f, 1.5f}) {
        const std::vector<Triangle> triangles = scatteredTriangles(2000, size, 4);
        const Bvh bvh = buildBvh(triangles, {.splitBudget = 1.0f});
        if (size > 1.0f) {
            EXPECT_GT(bvh.leafTriangles.size(), triangles.size())
                << "nothing was split: the test tests nothing";
        }
        std::vector<std::vector<Box>> boxes(triangles.size());
        forEachSlot(bvh, [&](uint32_t node, uint32_t slot, uint32_t) {
            if (const uint32_t reference = childReference(bvh.nodes[node], slot); isLeaf(reference))
                for (const uint32_t id : leafOf(bvh, reference))
                    boxes[id].push_back(childBox(bvh.nodes[node], slot));
        });
        Random random(5);
        for (size_t id = 0; id < triangles.size(); ++id)
            for (int i = 0; i < 200; ++i) {
                const double s = std::sqrt(random.unit());
                const double r = random.unit();
                const glm::dvec3 p = (1.0 - s) * glm::dvec3(triangles[id].v0) +
                                     s * (1.0 - r) * glm::dvec3(triangles[id].v1) +
                                     s * r * glm::dvec3(triangles[id].v2);
                EXPECT_TRUE(std::any_of(boxes[id].begin(), boxes[id].end(),
                                        [&](const Box& b) { return b.contains(p); }));
            }
    }
}

TEST(Bvh, BoxesContainTheBoxesAndTrianglesBelowThem) {
    const std::vector<Triangle> triangles = scatteredTriangles(3000, 0.3f, 6);
    const Bvh bvh = buildBvh(triangles, {.splitBudget = 0.0f});
    forEachSlot(bvh, [&](uint32_t node, uint32_t slot, uint32_t) {
        const uint32_t reference = childReference(bvh.nodes[node], slot);
        const Box box = childBox(bvh.nodes[node], slot);
        if (isLeaf(reference)) {
            for (const uint32_t id : leafOf(bvh, reference))
                for (const glm::vec3& v : {triangles[id].v0, triangles[id].v1, triangles[id].v2})
                    EXPECT_TRUE(box.contains(v));
            return;
        }
        EXPECT_TRUE(box.contains(bvh.nodes[reference].origin)); // the exact lower corner of what is below
    });
}

TEST(Bvh, BoxesHaveNoMoreRoomThanTheGridGives) {
    const std::vector<Triangle> triangles = scatteredTriangles(3000, 0.1f, 7);
    const Bvh bvh = buildBvh(triangles, {.splitBudget = 0.0f});
    forEachSlot(bvh, [&](uint32_t node, uint32_t slot, uint32_t) {
        const uint32_t reference = childReference(bvh.nodes[node], slot);
        if (!isLeaf(reference) || leafOf(bvh, reference).empty())
            return;
        glm::dvec3 lower(HUGE_VAL), upper(-HUGE_VAL);
        for (const uint32_t id : leafOf(bvh, reference))
            for (const glm::vec3& v : {triangles[id].v0, triangles[id].v1, triangles[id].v2}) {
                lower = glm::min(lower, glm::dvec3(v));
                upper = glm::max(upper, glm::dvec3(v));
            }
        const Box box = childBox(bvh.nodes[node], slot);
        for (int axis = 0; axis < 3; ++axis) {
            const double step =
                std::ldexp(1.0, static_cast<int>(bvh.nodes[node].exponents >> (8 * axis) & 0xffu) - 127);
            EXPECT_LT(lower[axis] - box.lower[axis], step);
            EXPECT_LT(box.upper[axis] - upper[axis], step);
        }
    });
}

TEST(Bvh, IsTheSameForEveryNumberOfThreads) {
    const std::vector<Triangle> triangles = sceneTriangles(makeDenseScene(60000));
    const Bvh one = buildBvh(triangles, {.threads = 1});
    EXPECT_TRUE(sameTree(one, buildBvh(triangles, {.threads = 1})));
    EXPECT_TRUE(sameTree(one, buildBvh(triangles, {.threads = 2})));
    EXPECT_TRUE(sameTree(one, buildBvh(triangles)));
}

TEST(Bvh, FillsItsNodes) {
    const Bvh bvh = buildBvh(scatteredTriangles(5000, 0.05f, 9));
    uint32_t used = 0;
    forEachSlot(bvh, [&](uint32_t node, uint32_t slot, uint32_t) {
        const uint32_t reference = childReference(bvh.nodes[node], slot);
        used += !isLeaf(reference) || !leafOf(bvh, reference).empty();
    });
    EXPECT_GT(used, 6.0 * static_cast<double>(bvh.nodes.size()));
}

TEST(Bvh, OfNothingNeverHits) {
    const Bvh bvh = buildBvh({});
    ASSERT_EQ(bvh.nodes.size(), 1u);
    EXPECT_TRUE(bvh.leafTriangles.empty());
    for (uint32_t slot = 0; slot < kBvhWidth; ++slot) {
        EXPECT_TRUE(isLeaf(childReference(bvh.nodes[0], slot)));
        EXPECT_TRUE(leafOf(bvh, childReference(bvh.nodes[0], slot)).empty());
        EXPECT_TRUE(childBox(bvh.nodes[0], slot).isEmpty());
    }
    EXPECT_EQ(bvh.bounds.lower, bvh.bounds.upper);
}

TEST(Bvh, OfOneTriangleFindsIt) {
    const std::vector<Triangle> triangle{{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}};
    const Bvh bvh = buildBvh(triangle);
    expectSound(bvh, 1);
    EXPECT_EQ(closestInTree(bvh, triangle, {{0.2f, 0.2f, 0}, {0, 0, 1}}), (WalkHit{2.0, 0}));
    EXPECT_EQ(bvh.bounds.upper, glm::vec3(1, 1, 2));
}

TEST(Bvh, TakesFiftyThousandIdenticalTriangles) {
    const std::vector<Triangle> triangles(50000, Triangle{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}});
    expectSound(buildBvh(triangles), triangles.size());
}

TEST(Bvh, TakesTrianglesWithoutArea) {
    std::vector<Triangle> points(5000, Triangle{glm::vec3(3), glm::vec3(3), glm::vec3(3)});
    expectSound(buildBvh(points), points.size());
    Random random(10);
    for (Triangle& line : points) {
        line.v0 = randomPoint(random, 1.0f);
        line.v1 = line.v2 = line.v0 + glm::vec3(1, 0, 0);
    }
    expectSound(buildBvh(points), points.size());
}

TEST(Bvh, IsTheSameTreeAtEveryScale) {
    const std::vector<Triangle> triangles = scatteredTriangles(5000, 1.0f, 11);
    const Bvh bvh = buildBvh(triangles);
    for (const float scale : {0x1p60f, 0x1p-60f})
        EXPECT_EQ(buildBvh(scaled(triangles, scale)).leafTriangles, bvh.leafTriangles);
}

TEST(Bvh, TakesHugeAndTinyScenes) {
    const std::vector<Triangle> triangles = scatteredTriangles(5000, 1.0f, 11);
    for (const float scale : {4e18f, 1e-38f, 1e-44f})
        expectSound(buildBvh(scaled(triangles, scale)), triangles.size());
}

TEST(Bvh, StaysShallowWhereSizesSpanManyPowersOfTwo) {
    std::vector<Triangle> triangles;
    addHalvingRow(triangles, glm::vec3(0.0f), 0, 60);
    expectSound(buildBvh(triangles), triangles.size());
}

TEST(Bvh, StaysShallowWhereEmbreeGivesUp) {
    const std::vector<Triangle> triangles = trianglesBeyondEmbreesDepth();
    expectSound(buildBvh(triangles), triangles.size());
}

TEST(Bvh, RefusesCoordinatesThatAreNotFiniteOrTooLarge) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(), 1e19f}) {
        std::vector<Triangle> triangles = scatteredTriangles(10, 1.0f, 13);
        triangles[7].v1.z = bad;
        EXPECT_THROW((void)buildBvh(triangles), Error);
    }
}

TEST(Bvh, RefusesWhatDoesNotFit) {
    EXPECT_NO_THROW(requireBvhFits(kMostTexels / kTriangleTexels, kMaxNodes));
    EXPECT_THROW(requireBvhFits(kMostTexels / kTriangleTexels + 1, 0), Error);
    EXPECT_THROW(requireBvhFits(0, kMaxNodes + 1), Error);
}

} // namespace
} // namespace lavalight::test
