// A tree along a Z curve finds what meets a box: all of it, once, and nothing else.
#include "accel/z_curve_tree.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/random_numbers.h"

namespace lavalight::test {
namespace {

glm::vec3 somewhere(Random& random) {
    return {random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f)};
}

std::vector<Triangle> someTriangles(size_t count, Random& random) {
    std::vector<Triangle> triangles;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 middle = somewhere(random);
        triangles.push_back({middle + 0.1f * somewhere(random), middle + 0.1f * somewhere(random),
                             middle + 0.1f * somewhere(random)});
    }
    return triangles;
}

bool meets(const Triangle& t, const Box& box) {
    const glm::vec3 lower = glm::min(glm::min(t.v0, t.v1), t.v2);
    const glm::vec3 upper = glm::max(glm::max(t.v0, t.v1), t.v2);
    return glm::all(glm::lessThanEqual(lower, box.upper)) &&
           glm::all(glm::greaterThanEqual(upper, box.lower));
}

std::vector<uint32_t> foundIn(const ZCurveTree& tree, const Box& box) {
    std::vector<uint32_t> ids;
    tree.visitIn(box, [&](size_t place) {
        ids.push_back(tree.id(place));
        return true;
    });
    std::ranges::sort(ids);
    return ids;
}

TEST(ZCurveTree, FindsWhatMeetsABox) {
    Random random(1);
    for (const size_t count : {0, 1, 3, 4, 5, 16, 17, 1000}) {
        const std::vector<Triangle> triangles = someTriangles(count, random);
        const ZCurveTree tree(triangles);
        ASSERT_EQ(tree.triangles().size(), count);
        for (size_t place = 0; place < count; ++place)
            ASSERT_EQ(tree.triangles()[place].v0, triangles[tree.id(place)].v0);
        for (int i = 0; i < 100; ++i) {
            const glm::vec3 middle = somewhere(random);
            const glm::vec3 half(random.between(0.0f, 0.5f));
            const Box box{middle - half, middle + half};
            std::vector<uint32_t> expected;
            for (uint32_t id = 0; id < count; ++id)
                if (meets(triangles[id], box))
                    expected.push_back(id);
            ASSERT_EQ(foundIn(tree, box), expected) << count;
        }
    }
}

TEST(ZCurveTree, EndsWhereAVisitSaysSo) {
    Random random(2);
    const std::vector<Triangle> triangles = someTriangles(100, random);
    const ZCurveTree tree(triangles);
    int visits = 0;
    tree.visitIn({glm::vec3(-2.0f), glm::vec3(2.0f)}, [&](size_t) { return ++visits < 7; });
    EXPECT_EQ(visits, 7);
}

// The curve has one cell where all middles are the same.
TEST(ZCurveTree, HoldsTrianglesInOnePlaceAndOnALine) {
    const Triangle one{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(foundIn(ZCurveTree(std::vector<Triangle>(50, one)), {glm::vec3(0.2f), glm::vec3(0.3f)}).size(),
              0u);
    EXPECT_EQ(foundIn(ZCurveTree(std::vector<Triangle>(50, one)), {glm::vec3(0.0f), glm::vec3(0.3f)}).size(),
              50u);
    std::vector<Triangle> line;
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 shift(1e15f * static_cast<float>(i), 0.0f, 0.0f);
        line.push_back({one.v0 + shift, one.v1 + shift, one.v2 + shift});
    }
    const ZCurveTree tree(line);
    EXPECT_EQ(foundIn(tree, {{5e15f, 0, 0}, {8e15f, 0, 0}}), (std::vector<uint32_t>{5, 6, 7, 8}));
    EXPECT_EQ(foundIn(tree, {glm::vec3(-INFINITY), glm::vec3(INFINITY)}).size(), 50u);
}

} // namespace
} // namespace lavalight::test
