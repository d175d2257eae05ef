// Every triangle is in one leaf, boxes are never too small, and no input makes the tree fail or grow too
// deep.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "accel/bvh16.h"
#include "base/error.h"
#include "support/scattered_triangles.h"

namespace lavalight::test {
namespace {

struct Box {
    glm::vec3 lower{std::numeric_limits<float>::infinity()};
    glm::vec3 upper{-std::numeric_limits<float>::infinity()};

    bool operator==(const Box&) const = default;
    [[nodiscard]] double area() const {
        const glm::dvec3 e = glm::dvec3(upper) - glm::dvec3(lower);
        return e.x * e.y + e.y * e.z + e.z * e.x;
    }
};

// Walks a tree and checks what every tree owes, whatever the input.
class Walk {
  public:
    Walk(const Bvh16& bvh, const std::vector<Triangle>& triangles) : bvh_(&bvh), triangles_(&triangles) {
        times_.resize(triangles.size());
        const Box all = box(0, 1);
        for (const uint32_t times : times_)
            EXPECT_EQ(times, 1u) << "each triangle is in one leaf";
        EXPECT_EQ(nodes_, bvh.nodes.size());
        EXPECT_EQ(leaves_, bvh.leaves.size());
        EXPECT_LE(levels, kMaxBvh16Levels);
        if (!triangles.empty()) {
            EXPECT_EQ(all.lower, bvh.bounds.lower);
            EXPECT_EQ(all.upper, bvh.bounds.upper);
        }
    }

    uint32_t levels = 0;

  private:
    Box box(uint32_t child, uint32_t level) {
        return (child & kBvh16LeafBit) != 0 ? leafBox(bvh_->leaves[child & ~kBvh16LeafBit])
                                            : nodeBox(child, level);
    }
    Box leafBox(const Bvh16Leaf& leaf) {
        ++leaves_;
        Box box;
        for (size_t lane = 0; lane < kBvh16LeafWidth; ++lane) {
            glm::vec3 corners[3];
            for (size_t corner = 0; corner < 3; ++corner)
                corners[corner] = {leaf.corners[corner][0][lane], leaf.corners[corner][1][lane],
                                   leaf.corners[corner][2][lane]};
            const uint32_t id = leaf.triangles[lane];
            const Triangle& triangle = (*triangles_)[id];
            const glm::vec3 expected[] = {triangle.v0, triangle.v1, triangle.v2};
            if (!std::equal(corners, corners + 3, expected)) {
                EXPECT_TRUE(corners[0] == corners[1] && corners[1] == corners[2])
                    << "a lane without a triangle";
                continue;
            }
            ++times_[id];
            for (const glm::vec3& corner : corners) {
                box.lower = glm::min(box.lower, corner);
                box.upper = glm::max(box.upper, corner);
            }
        }
        return box;
    }
    Box nodeBox(uint32_t index, uint32_t level) {
        ++nodes_;
        levels = std::max(levels, level);
        Box all;
        double areaBefore = std::numeric_limits<double>::infinity();
        for (size_t lane = 0; lane < kBvh16Width; ++lane) {
            const Bvh16Node& node = bvh_->nodes[index];
            Box said;
            for (int axis = 0; axis < 3; ++axis) {
                said.lower[axis] = node.planes[static_cast<size_t>(axis)][lane];
                said.upper[axis] = node.planes[static_cast<size_t>(3 + axis)][lane];
            }
            if (said == Box{})
                continue;
            EXPECT_EQ(box(node.children[lane], level + 1), said);
            EXPECT_LE(said.area(), areaBefore) << "larger children come first";
            areaBefore = said.area();
            all.lower = glm::min(all.lower, said.lower);
            all.upper = glm::max(all.upper, said.upper);
        }
        return all;
    }

    const Bvh16* bvh_;
    const std::vector<Triangle>* triangles_;
    std::vector<uint32_t> times_;
    size_t nodes_ = 0;
    size_t leaves_ = 0;
};

TEST(Bvh16, HoldsEveryTriangleInBoxesThatFit) {
    for (const uint32_t count : {1u, 2u, 8u, 9u, 17u, 128u, 129u, 1000u, 20000u}) {
        SCOPED_TRACE(count);
        const std::vector<Triangle> triangles = scatteredTriangles(count, 0.3f, count);
        const Bvh16 bvh = buildBvh16(triangles);
        (void)Walk(bvh, triangles);
        EXPECT_LE(bvh.leaves.size(), count / 4 + 2) << "leaves are half full at least, but for a few";
        EXPECT_LE(bvh.nodes.size(), bvh.leaves.size() / 4 + 1) << "nodes have four children on average";
    }
}

TEST(Bvh16, OfNothingIsARootWithoutChildren) {
    const Bvh16 bvh = buildBvh16({});
    ASSERT_EQ(bvh.nodes.size(), 1u);
    EXPECT_EQ(bvh.leaves.size(), 1u) << "what missing children refer to";
    EXPECT_EQ(bvh.nodes[0].planes[0][0], std::numeric_limits<float>::infinity());
}

TEST(Bvh16, HoldsTheMaterialsOfItsTriangles) {
    const std::vector<Triangle> triangles = scatteredTriangles(100, 0.3f, 1);
    std::vector<uint32_t> materials;
    for (uint32_t id = 0; id < 100; ++id)
        materials.push_back(1000 + id);
    for (const Bvh16Leaf& leaf : buildBvh16(triangles, materials).leaves)
        for (size_t lane = 0; lane < kBvh16LeafWidth; ++lane)
            EXPECT_TRUE(leaf.materials[lane] == 1000 + leaf.triangles[lane] || leaf.materials[lane] == 0u);
    for (const Bvh16Leaf& leaf : buildBvh16(triangles).leaves)
        EXPECT_EQ(leaf.materials, (std::array<uint32_t, kBvh16LeafWidth>{}));
}

TEST(Bvh16, TakesTrianglesInOnePlaceAndDegenerateOnes) {
    std::vector<Triangle> triangles(1000, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    (void)Walk(buildBvh16(triangles), triangles);
    triangles.assign(1000, {{2, 2, 2}, {2, 2, 2}, {2, 2, 2}});
    EXPECT_EQ(buildBvh16(triangles).bounds.lower, glm::vec3(2.0f));
}

TEST(Bvh16, TakesHugeAndTinyScenes) {
    const std::vector<Triangle> triangles = scatteredTriangles(5000, 1.0f, 11);
    for (const float scale : {4e18f, 1e-38f}) {
        const std::vector<Triangle> there = scaled(triangles, scale);
        EXPECT_GT(buildBvh16(there).nodes.size(), 5000 / kBvh16LeafWidth / kBvh16Width);
    }
}

TEST(Bvh16, StaysShallowWhereAreasPeelOffAFew) {
    const std::vector<Triangle> triangles = trianglesBeyondEmbreesDepth();
    EXPECT_GT(Walk(buildBvh16(triangles), triangles).levels, 20u) << "a row that is easy to build over";
}

TEST(Bvh16, RefusesCoordinatesThatAreNotFiniteOrTooLarge) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(), 1e19f}) {
        std::vector<Triangle> triangles = scatteredTriangles(10, 1.0f, 13);
        triangles[7].v1.z = bad;
        EXPECT_THROW((void)buildBvh16(triangles), Error);
    }
}

} // namespace
} // namespace lavalight::test
