// A ray through a Bvh16 meets what comes first of all triangles, to the bit, by vectors of any width.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "hosted/bvh16_rays.h"
#include "shared/scene.h"
#include "support/scattered_triangles.h"

namespace lavalight::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kNone = 0xffffffffu;

// Takes what it is asked about, or nothing, and counts.
struct Taker {
    bool takesAny = true;
    std::vector<uint32_t> asked{};

    TriangleTaker get() {
        return {[](void* taker, const Bvh16Hit& hit) {
                    Taker& self = *static_cast<Taker*>(taker);
                    self.asked.push_back(hit.triangle);
                    return self.takesAny;
                },
                this};
    }
};

Bvh16Ray makeRay(const glm::vec3& origin, glm::vec3 direction) {
    for (int axis = 0; axis < 3; ++axis) // withoutZeros()
        direction[axis] = std::copysign(std::max(std::abs(direction[axis]), 1e-18f), direction[axis]);
    const glm::vec3 size = glm::abs(direction);
    const int main = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const glm::vec3 turned(direction[(main + 1) % 3], direction[(main + 2) % 3], direction[main]);
    return {.origin = origin,
            .direction = direction,
            .shear = glm::vec3(turned.x, turned.y, 1.0f) / turned.z,
            .mainAxis = main,
            .end = kInfinity,
            .firstIgnored = kNone,
            .secondIgnored = kNone,
            .cullsBackFaces = false};
}

bool isSame(const std::optional<Bvh16Hit>& a, const std::optional<Bvh16Hit>& b) {
    return a.has_value() == b.has_value() &&
           (!a || (std::bit_cast<uint32_t>(a->t) == std::bit_cast<uint32_t>(b->t) &&
                   a->triangle == b->triangle && a->barycentrics == b->barycentrics && a->front == b->front));
}

// A tree of each triangle, in a box that every ray meets.
class AloneTrees {
  public:
    explicit AloneTrees(const std::vector<Triangle>& triangles) {
        for (const Triangle& triangle : triangles) {
            Bvh16& tree = trees_.emplace_back(buildBvh16(std::span(&triangle, 1)));
            for (size_t plane = 0; plane < 6; ++plane)
                tree.nodes[0].planes[plane][0] = plane < 3 ? -kInfinity : kInfinity;
        }
    }
    [[nodiscard]] std::optional<Bvh16Hit> first(const Bvh16Ray& ray) const {
        std::optional<Bvh16Hit> first;
        for (uint32_t id = 0; id < trees_.size(); ++id)
            if (std::optional<Bvh16Hit> hit = traverse(trees_[id], ray, {}, false);
                hit && (!first || hit->t < first->t)) {
                hit->triangle = id;
                first = hit;
            }
        return first;
    }

  private:
    std::vector<Bvh16> trees_;
};

// Rays to triangles around a place `away` from the world's origin: from within and from far, in random
// directions, along axes, and at corners and edges exactly.
std::vector<Bvh16Ray> variousRays(const std::vector<Triangle>& triangles, uint32_t count, float away = 0.0f) {
    Random random(5);
    std::vector<Bvh16Ray> rays;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 origin = away + randomPoint(random, i % 3 == 0 ? 300.0f : 1.5f);
        const Triangle& aimedAt = triangles[i % triangles.size()];
        const glm::vec3 targets[] = {aimedAt.v0, 0.5f * (aimedAt.v0 + aimedAt.v1),
                                     (aimedAt.v0 + aimedAt.v1 + aimedAt.v2) / 3.0f};
        rays.push_back(makeRay(origin, glm::normalize(targets[i / 3 % 3] - origin)));
        rays.push_back(makeRay(away + randomPoint(random, 1.5f), random.direction()));
        glm::vec3 axis(0.0f);
        axis[static_cast<int>(i % 3)] = i % 2 == 0 ? 1.0f : -1.0f;
        rays.push_back(makeRay({aimedAt.v0.x, aimedAt.v1.y, aimedAt.v2.z}, axis));
    }
    return rays;
}

TEST(Bvh16Rays, MeetWhatComesFirstOfAllTriangles) {
    for (const float size : {0.2f, 1.5f})
        for (const float away : {0.0f, 3000.0f}) {
            std::vector<Triangle> triangles = scatteredTriangles(150, size, 1);
            triangles.insert(triangles.end(), triangles.begin(),
                             triangles.begin() + 150); // each is there twice
            for (Triangle& t : triangles)
                t = {t.v0 + away, t.v1 + away, t.v2 + away};
            const Bvh16 bvh = buildBvh16(triangles);
            const AloneTrees alone(triangles);
            size_t met = 0;
            for (const Bvh16Ray& ray : variousRays(triangles, 1000, away)) {
                const std::optional<Bvh16Hit> expected = alone.first(ray);
                const std::optional<Bvh16Hit> hit = traverse(bvh, ray, {}, false);
                ASSERT_TRUE(isSame(hit, expected));
                EXPECT_EQ(traverse(bvh, ray, {}, true).has_value(), expected.has_value());
                met += hit ? 1 : 0;
                EXPECT_TRUE(!hit || hit->triangle < 150) << "the lowest of those in one place";
            }
            EXPECT_GT(met, 500u);
        }
}

TEST(Bvh16Rays, MeetTheSameByVectorsOfFour) {
    const std::vector<Triangle> triangles = scatteredTriangles(5000, 0.2f, 2);
    const Bvh16 bvh = buildBvh16(triangles);
    size_t met = 0;
    for (const Bvh16Ray& ray : variousRays(triangles, 5000)) {
        const std::optional<Bvh16Hit> hit = traverse(bvh, ray, {}, false);
        ASSERT_TRUE(isSame(hit, traverseByFour(bvh, ray, {}, false)));
        ASSERT_EQ(traverse(bvh, ray, {}, true).has_value(), hit.has_value());
        ASSERT_EQ(traverseByFour(bvh, ray, {}, true).has_value(), hit.has_value());
        met += hit ? 1 : 0;
    }
    EXPECT_GT(met, 2500u);
}

TEST(Bvh16Rays, EndBeforeTheirEndAndPassWhatTheyIgnore) {
    const std::vector<Triangle> triangles = scatteredTriangles(2000, 0.3f, 3);
    const Bvh16 bvh = buildBvh16(triangles);
    size_t met = 0;
    for (Bvh16Ray ray : variousRays(triangles, 300)) {
        const std::optional<Bvh16Hit> first = traverse(bvh, ray, {}, false);
        if (!first)
            continue;
        ++met;
        ray.end = first->t;
        EXPECT_FALSE(traverse(bvh, ray, {}, false).has_value());
        EXPECT_FALSE(traverse(bvh, ray, {}, true).has_value());
        ray.end = std::nextafter(first->t, kInfinity);
        EXPECT_TRUE(isSame(traverse(bvh, ray, {}, false), first));
        ray.end = kInfinity;
        ray.firstIgnored = first->triangle;
        const std::optional<Bvh16Hit> second = traverse(bvh, ray, {}, false);
        EXPECT_TRUE(!second || (second->t >= first->t && second->triangle != first->triangle));
        if (!second)
            continue;
        ray.secondIgnored = second->triangle;
        const std::optional<Bvh16Hit> third = traverse(bvh, ray, {}, false);
        EXPECT_TRUE(!third || (third->t >= second->t && third->triangle != first->triangle &&
                               third->triangle != second->triangle));
    }
    EXPECT_GT(met, 300u);
}

// Three triangles, one behind another; of the middle one the taker is asked.
TEST(Bvh16Rays, AskAboutAlphaAndAboutBacksThatTheyCull) {
    std::vector<Triangle> triangles;
    for (const float z : {-1.0f, -2.0f, -3.0f})
        triangles.push_back({{-9, -9, z}, {9, -9, z}, {0, 9, z}}); // the front is towards +z
    const std::vector<uint32_t> materials{0, kAlphaBit, 0};
    const Bvh16 bvh = buildBvh16(triangles, materials);
    const auto meets = [&](bool fromBehind, bool culls, bool takesAny, std::vector<uint32_t> asked) {
        Taker taker{takesAny};
        Bvh16Ray ray = makeRay({0, 0, fromBehind ? -9.0f : 0.0f}, {0, 0, fromBehind ? 1.0f : -1.0f});
        ray.firstIgnored = fromBehind ? 2 : 0;
        ray.cullsBackFaces = culls;
        const std::optional<Bvh16Hit> hit = traverse(bvh, ray, taker.get(), false);
        EXPECT_EQ(taker.asked, asked);
        EXPECT_TRUE(!hit || hit->front != fromBehind);
        return hit ? hit->triangle : kNone;
    };
    EXPECT_EQ(meets(false, false, true, {1}), 1u);
    EXPECT_EQ(meets(false, false, false, {1}), 2u) << "goes on where it is let through";
    EXPECT_EQ(meets(false, true, false, {1}), 2u) << "fronts are not culled";
    EXPECT_EQ(meets(true, false, false, {1}), 0u);
    EXPECT_EQ(meets(true, true, false, {1, 0}), kNone) << "backs are";
    Taker taker{false};
    EXPECT_TRUE(traverse(bvh, makeRay({0, 0, -1.5f}, {0, 0, -1}), taker.get(), true).has_value());
}

TEST(Bvh16Rays, MeetNothingWhereTheyAreNoNumbers) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const uint32_t count : {0u, 3u, 100u, 1000u}) {
        const Bvh16 bvh = buildBvh16(scatteredTriangles(count, 1.0f, 4));
        for (const float bad : {nan, kInfinity, -kInfinity}) {
            EXPECT_FALSE(traverse(bvh, makeRay({bad, 0, 0}, {0.1f, 0.1f, 1}), {}, false).has_value());
            EXPECT_FALSE(traverse(bvh, makeRay({0, 0, 0}, {0.1f, bad, 1}), {}, true).has_value());
        }
        EXPECT_FALSE(traverse(bvh, makeRay({0, 3e38f, 0}, {0.1f, 0.1f, 1}), {}, false).has_value());
    }
}

} // namespace
} // namespace lavalight::test
