// Every light is in the tree once, where its path says, and inside the bounds of all nodes above it.
#include "light/light_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shared/scene.h"
#include "support/random_numbers.h"

namespace lavalight::test {
namespace {

using std::numbers::pi;

LightBounds lampAt(const glm::dvec3& p) {
    LightBounds bounds;
    bounds.lower = bounds.upper = p;
    bounds.cone.spread = pi;
    bounds.intensity = 1.0;
    return bounds;
}

glm::dvec3 randomDirection(Random& random) {
    const double z = random.between(-1.0f, 1.0f);
    const double phi = random.between(0.0f, 6.2831853f);
    return {std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z};
}

std::vector<LightBounds> randomPanels(size_t count) {
    Random random(2);
    std::vector<LightBounds> lights(count);
    for (LightBounds& light : lights) {
        light.lower = {random.between(-9.0f, 9.0f), random.between(-9.0f, 9.0f), random.between(0.0f, 3.0f)};
        light.upper = light.lower + glm::dvec3(random.unit(), random.unit(), 0.0);
        light.cone = {randomDirection(random), 0.3 * random.unit(), 0.5 * pi};
        light.isTwoSided = random.unit() < 0.3f;
        light.intensity = std::pow(10.0, double{random.between(-3.0f, 3.0f)});
    }
    return lights;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

// Whether each direction that light may take from `inner`, it may take from `outer`, by the cone's rim and
// axis.
bool coneContains(const LightBounds& outer, const LightBounds& inner) {
    const double slack = 1e-6;
    const double between = angleBetween(outer.cone.axis, inner.cone.axis);
    const double nearest = outer.isTwoSided ? std::min(between, pi - between) : between;
    return outer.cone.falloff >= inner.cone.falloff && (outer.isTwoSided || !inner.isTwoSided) &&
           (outer.cone.spread >= pi - slack || nearest + inner.cone.spread <= outer.cone.spread + slack);
}

void expectContains(const LightBounds& outer, const LightBounds& inner, uint32_t light) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(outer.lower[axis], inner.lower[axis]) << "light " << light;
        EXPECT_GE(outer.upper[axis], inner.upper[axis]) << "light " << light;
    }
    EXPECT_TRUE(coneContains(outer, inner)) << "light " << light;
}

void expectSound(const std::vector<LightBounds>& lights) {
    const LightTree tree = buildLightTree(lights);
    ASSERT_EQ(tree.nodes.size() % kLightTreeWidth, 1u);
    ASSERT_EQ(tree.paths.size(), lights.size());
    double intensity = 0.0;
    for (uint32_t light = 0; light < lights.size(); ++light) {
        uint32_t node = 0;
        uint32_t level = 0;
        for (; !tree.nodes[node].isLeaf; ++level) {
            ASSERT_LT(level, kMostLightTreeLevels);
            expectContains(tree.nodes[node].bounds, lights[light], light);
            const uint32_t child = tree.paths[light] >> (kLightTreeChildBits * level) & (kLightTreeWidth - 1);
            node = tree.nodes[node].index + child;
            ASSERT_LT(node, tree.nodes.size());
        }
        EXPECT_EQ(tree.nodes[node].index, light);
        intensity += lights[light].intensity;
    }
    EXPECT_NEAR(tree.nodes[0].bounds.intensity, intensity, 1e-9 * intensity);
    size_t leaves = 0; // that are no gaps
    for (const LightTreeNode& node : tree.nodes)
        leaves += node.isLeaf && node.bounds.intensity > 0.0 ? 1 : 0;
    EXPECT_EQ(leaves, lights.size());
}

uint32_t levelsOf(const LightTree& tree, uint32_t node = 0) {
    if (tree.nodes[node].isLeaf)
        return 0;
    uint32_t levels = 0;
    for (uint32_t i = 0; i < kLightTreeWidth; ++i)
        levels = std::max(levels, levelsOf(tree, tree.nodes[node].index + i));
    return 1 + levels;
}

TEST(LightTree, PathsLeadToLightsThroughNodesThatBoundThem) {
    expectSound(randomPanels(1));
    expectSound(randomPanels(2));
    expectSound(randomPanels(3000));
}

// Nodes are filled as far as there are lights.
TEST(LightTree, HasEightChildrenANode) {
    const LightTree eight = buildLightTree(randomPanels(8));
    EXPECT_EQ(eight.nodes.size(), 9u);
    EXPECT_EQ(levelsOf(eight), 1u);
    EXPECT_EQ(levelsOf(buildLightTree(std::vector<LightBounds>(512, lampAt({1, 2, 3})))), 3u);
    EXPECT_LE(levelsOf(buildLightTree(randomPanels(3000))), 6u);
    for (const size_t count : {16, 1024, 3000}) // gaps at most: leaves two by two
        EXPECT_LT(buildLightTree(randomPanels(count)).nodes.size(), 5 * count) << count;
}

TEST(LightTree, WithoutLightsIsEmpty) {
    EXPECT_TRUE(buildLightTree({}).nodes.empty());
}

TEST(LightTree, HoldsLightsThatAreAllInOnePlace) {
    expectSound(std::vector<LightBounds>(1000, lampAt({1, 2, 3})));
}

// Each split by cost would take one light off: a tree of 300 levels.
TEST(LightTree, IsNoDeeperThanItsPathsAreLong) {
    std::vector<LightBounds> lights;
    for (int i = 0; i < 300; ++i)
        lights.push_back(lampAt({std::pow(20.0, i), 0, 0}));
    expectSound(lights);
}

TEST(LightTree, SeparatesLightsThatShineApart) {
    std::vector<LightBounds> lights;
    for (int i = 0; i < 16; ++i) { // one half up, one half down, in a row
        lights.push_back(lampAt({i, 0, 0}));
        lights.back().cone = {{0, 0, i < 8 ? 1 : -1}, 0.0, 0.5 * pi};
    }
    const LightTree tree = buildLightTree(lights);
    for (uint32_t i = 0; i < kLightTreeWidth; ++i)
        EXPECT_LT(tree.nodes[tree.nodes[0].index + i].bounds.cone.spread, 0.01);
}

TEST(LightCone, OfTwoTouchesTheFarRimsOfBoth) {
    LightBounds a = lampAt({});
    LightBounds b = lampAt({});
    a.cone = {{1, 0, 0}, 0.2, 0.1};
    b.cone = {{0, 1, 0}, 0.4, 0.3};
    const LightCone both = unite(a, b).cone;
    EXPECT_NEAR(both.spread, 0.5 * (0.2 + 0.5 * pi + 0.4), 1e-12);
    EXPECT_NEAR(angleBetween(both.axis, a.cone.axis), both.spread - 0.2, 1e-12);
    EXPECT_NEAR(angleBetween(both.axis, b.cone.axis), both.spread - 0.4, 1e-12);
    EXPECT_EQ(both.falloff, 0.3);
}

TEST(LightCone, OfPanelsThatShineToBothSidesNeedNotSpanTheirAxes) {
    LightBounds a = lampAt({});
    a.cone = {{0, 0, 1}, 0.0, 0.5 * pi};
    a.isTwoSided = true;
    LightBounds b = a;
    b.cone.axis = {0, 0, -1};
    EXPECT_EQ(unite(a, b).cone.spread, 0.0);
}

TEST(LightBounds, OfASpotReachItsOuterCone) {
    PunctualLight light;
    light.kind = PunctualKind::spot;
    light.innerConeAngle = 0.25f;
    light.outerConeAngle = 0.75f;
    light.intensity = {1.0f, 2.0f, 6.0f};
    const LightBounds bounds = boundsOf(light);
    EXPECT_EQ(bounds.cone.spread, 0.25);
    EXPECT_EQ(bounds.cone.falloff, 0.5);
    EXPECT_EQ(bounds.intensity, 3.0);
}

} // namespace
} // namespace lavalight::test
