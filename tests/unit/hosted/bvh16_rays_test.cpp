// Rays through a Bvh16 meet what comes first of all triangles, to the bit, alone and together and by vectors
// of any width.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "hosted/bvh16_rays.h"
#include "shared/scene.h"
#include "support/scattered_triangles.h"

namespace lavalight::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Takes what it is asked about, or nothing, and keeps what that was.
struct Taker {
    bool takesAny = true;
    std::vector<uint32_t> asked{};

    TriangleTaker get() {
        return {[](void* taker, size_t, const Bvh16Hit& hit) {
                    Taker& self = *static_cast<Taker*>(taker);
                    self.asked.push_back(hit.triangle);
                    return self.takesAny;
                },
                this};
    }
};

std::vector<Bvh16Hit> find(const Bvh16& bvh, const std::vector<Bvh16Ray>& rays, Sought sought,
                           Likeness likeness = Likeness::unlike, TriangleTaker taker = {},
                           void (*by)(const Bvh16Query&) = traverse) {
    std::vector<Bvh16Hit> hits(rays.size());
    by({bvh, rays, sought, likeness, taker, hits});
    return hits;
}

bool isFound(const Bvh16Hit& hit) {
    return hit.triangle != kNoTriangle;
}

Bvh16Ray makeRay(const glm::vec3& origin, const glm::vec3& direction) {
    return {.origin = origin,
            .direction = direction,
            .end = kInfinity,
            .firstIgnored = kNoTriangle,
            .secondIgnored = kNoTriangle,
            .cullsBackFaces = false};
}

bool isSame(const Bvh16Hit& a, const Bvh16Hit& b) {
    return a.triangle == b.triangle &&
           (!isFound(a) ||
            (std::bit_cast<uint32_t>(a.t) == std::bit_cast<uint32_t>(b.t) && a.material == b.material &&
             a.barycentrics == b.barycentrics && a.front == b.front));
}

// What a ray meets alone, and in the company of copies.
Bvh16Hit findOne(const Bvh16& bvh, const Bvh16Ray& ray, Sought sought = Sought::first,
                 TriangleTaker taker = {}) {
    const Bvh16Hit alone = find(bvh, {ray}, sought, Likeness::unlike, taker)[0];
    for (const Likeness likeness : {Likeness::unlike, Likeness::alike})
        for (const Bvh16Hit& hit : find(bvh, {ray, ray, ray}, sought, likeness, taker))
            EXPECT_TRUE(sought == Sought::any ? isFound(hit) == isFound(alone) : isSame(hit, alone));
    return alone;
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
    [[nodiscard]] std::vector<Bvh16Hit> first(const std::vector<Bvh16Ray>& rays) const {
        std::vector<Bvh16Hit> first(rays.size(), Bvh16Hit{kInfinity, kNoTriangle, 0, {}, false});
        for (uint32_t id = 0; id < trees_.size(); ++id) {
            const std::vector<Bvh16Hit> hits = find(trees_[id], rays, Sought::first);
            for (size_t i = 0; i < rays.size(); ++i)
                if (isFound(hits[i]) && hits[i].t < first[i].t) {
                    first[i] = hits[i];
                    first[i].triangle = id;
                }
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
    for (const uint32_t count : {30u, 150u}) // in one node, and in more
        for (const float size : {0.2f, 1.5f})
            for (const float away : {0.0f, 3000.0f}) {
                std::vector<Triangle> triangles = scatteredTriangles(count, size, 1);
                triangles.insert(triangles.end(), triangles.begin(),
                                 triangles.begin() + count); // each is there twice
                for (Triangle& t : triangles)
                    t = {t.v0 + away, t.v1 + away, t.v2 + away};
                const Bvh16 bvh = buildBvh16(triangles);
                EXPECT_EQ(bvh.nodes.size() == 1, count == 30);
                const std::vector<Bvh16Ray> rays = variousRays(triangles, 1000, away);
                const std::vector<Bvh16Hit> expected = AloneTrees(triangles).first(rays);
                size_t met = 0;
                for (const Likeness likeness : {Likeness::unlike, Likeness::alike}) {
                    const std::vector<Bvh16Hit> hits = find(bvh, rays, Sought::first, likeness);
                    const std::vector<Bvh16Hit> any = find(bvh, rays, Sought::any, likeness);
                    for (size_t i = 0; i < rays.size(); ++i) {
                        ASSERT_TRUE(isSame(hits[i], expected[i])) << i;
                        ASSERT_EQ(isFound(any[i]), isFound(expected[i])) << i;
                        met += isFound(hits[i]) ? 1 : 0;
                        EXPECT_TRUE(!isFound(hits[i]) || hits[i].triangle < count)
                            << "the lowest of those in one place";
                    }
                }
                EXPECT_GT(met, 1000u);
            }
}

// Triangles of which every second has alpha, for rays that cull backs: whether a triangle is taken depends on
// ray and triangle alone.
TEST(Bvh16Rays, MeetTheSameAloneAndTogether) {
    for (const uint32_t count : {40u, 5000u}) {
        const std::vector<Triangle> triangles = scatteredTriangles(count, count == 40 ? 1.0f : 0.2f, 2);
        std::vector<uint32_t> materials;
        for (uint32_t id = 0; id < count; ++id)
            materials.push_back(id % 7 | (id % 2 == 0 ? kAlphaBit : 0));
        const Bvh16 bvh = buildBvh16(triangles, materials);
        std::vector<Bvh16Ray> rays = variousRays(triangles, 5000);
        for (size_t i = 0; i < rays.size(); ++i) {
            rays[i].cullsBackFaces = i % 3 == 0;
            rays[i].end = i % 5 == 0 ? 1.0f : kInfinity;
        }
        size_t firstOfRay = 0; // where it is alone
        const TriangleTaker taker{[](void* before, size_t ray, const Bvh16Hit& hit) {
                                      return (*static_cast<size_t*>(before) + ray + hit.triangle) % 3 != 0;
                                  },
                                  &firstOfRay};
        for (const Sought sought : {Sought::first, Sought::any}) {
            const std::vector<Bvh16Hit> together = find(bvh, rays, sought, Likeness::alike, taker);
            const std::vector<Bvh16Hit> others[] = {
                find(bvh, rays, sought, Likeness::unlike, taker),
                find(bvh, rays, sought, Likeness::alike, taker, traverseByFour),
                find(bvh, rays, sought, Likeness::unlike, taker, traverseByFour)};
            size_t met = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                firstOfRay = i;
                const Bvh16Hit alone = find(bvh, {rays[i]}, sought, Likeness::unlike, taker)[0];
                met += isFound(alone) ? 1 : 0;
                ASSERT_EQ(isFound(together[i]), isFound(alone)) << i;
                ASSERT_TRUE(sought == Sought::any || isSame(together[i], alone)) << i;
                for (const std::vector<Bvh16Hit>& hits : others)
                    ASSERT_TRUE(sought == Sought::any ? isFound(hits[i]) == isFound(alone)
                                                      : isSame(hits[i], alone))
                        << i;
                EXPECT_TRUE(!isFound(alone) || alone.material == materials[alone.triangle]);
            }
            firstOfRay = 0;
            EXPECT_GT(met, 5000u);
        }
    }
}

TEST(Bvh16Rays, EndBeforeTheirEndAndPassWhatTheyIgnore) {
    for (const uint32_t count : {40u, 2000u}) {
        const std::vector<Triangle> triangles = scatteredTriangles(count, count == 40 ? 1.0f : 0.3f, 3);
        const Bvh16 bvh = buildBvh16(triangles);
        size_t met = 0;
        for (Bvh16Ray ray : variousRays(triangles, 300)) {
            const Bvh16Hit nearest = findOne(bvh, ray);
            if (!isFound(nearest))
                continue;
            ++met;
            ray.end = nearest.t;
            EXPECT_FALSE(isFound(findOne(bvh, ray)));
            EXPECT_FALSE(isFound(findOne(bvh, ray, Sought::any)));
            ray.end = std::nextafter(nearest.t, kInfinity);
            EXPECT_TRUE(isSame(findOne(bvh, ray), nearest));
            ray.end = kInfinity;
            ray.firstIgnored = nearest.triangle;
            const Bvh16Hit second = findOne(bvh, ray);
            EXPECT_TRUE(!isFound(second) || (second.t >= nearest.t && second.triangle != nearest.triangle));
            if (!isFound(second))
                continue;
            ray.secondIgnored = second.triangle;
            const Bvh16Hit third = findOne(bvh, ray);
            EXPECT_TRUE(!isFound(third) || (third.t >= second.t && third.triangle != nearest.triangle &&
                                            third.triangle != second.triangle));
        }
        EXPECT_GT(met, 300u);
    }
}

// Three triangles, one behind another; of the middle one the taker is asked.
TEST(Bvh16Rays, AskAboutAlphaAndAboutBacksThatTheyCull) {
    std::vector<Triangle> triangles;
    for (const float z : {-1.0f, -2.0f, -3.0f})
        triangles.push_back({{-9, -9, z}, {9, -9, z}, {0, 9, z}}); // the front is towards +z
    const std::vector<uint32_t> materials{0, kAlphaBit, 0};
    // Far behind, so many triangles that they are several nodes, whose rays are found one by one.
    std::vector<Triangle> many = triangles;
    std::vector<uint32_t> materialsOfMany = materials;
    for (const Triangle& t : scatteredTriangles(500, 0.2f, 6)) {
        many.push_back({t.v0 + 50.0f, t.v1 + 50.0f, t.v2 + 50.0f});
        materialsOfMany.push_back(0);
    }
    for (const Bvh16& bvh : {buildBvh16(triangles, materials), buildBvh16(many, materialsOfMany)}) {
        const auto meets = [&](bool fromBehind, bool culls, bool takesAny,
                               const std::vector<uint32_t>& asked) {
            Taker taker{takesAny};
            Bvh16Ray ray = makeRay({0, 0, fromBehind ? -9.0f : 0.0f}, {0, 0, fromBehind ? 1.0f : -1.0f});
            ray.firstIgnored = fromBehind ? 2 : 0;
            ray.cullsBackFaces = culls;
            const Bvh16Hit hit = findOne(bvh, ray, Sought::first, taker.get());
            std::ranges::sort(taker.asked);
            taker.asked.erase(std::ranges::unique(taker.asked).begin(), taker.asked.end());
            EXPECT_EQ(taker.asked, asked);
            EXPECT_TRUE(!isFound(hit) || hit.front != fromBehind);
            return hit.triangle;
        };
        EXPECT_EQ(meets(false, false, true, {1}), 1u);
        EXPECT_EQ(meets(false, false, false, {1}), 2u) << "goes on where it is let through";
        EXPECT_EQ(meets(false, true, false, {1}), 2u) << "fronts are not culled";
        EXPECT_EQ(meets(true, false, false, {1}), 0u);
        EXPECT_EQ(meets(true, true, false, {0, 1}), kNoTriangle) << "backs are";
        Taker taker{false};
        EXPECT_TRUE(isFound(
            find(bvh, {makeRay({0, 0, -1.5f}, {0, 0, -1})}, Sought::any, Likeness::unlike, taker.get())[0]));
    }
}

// Components of directions that are smaller count as 1e-18, which may change the one that is the largest.
TEST(Bvh16Rays, HaveDirectionsWithoutZeros) {
    for (const uint32_t count : {40u, 2000u}) {
        const std::vector<Triangle> triangles = scatteredTriangles(count, count == 40 ? 1.0f : 0.3f, 3);
        const Bvh16 bvh = buildBvh16(triangles);
        size_t met = 0;
        for (const Bvh16Ray& ray : variousRays(triangles, 300)) {
            const auto meetsAlike = [&](const glm::vec3& small, const glm::vec3& smallest) {
                const Bvh16Hit hit = findOne(bvh, makeRay(ray.origin, small));
                EXPECT_TRUE(isSame(hit, findOne(bvh, makeRay(ray.origin, smallest))));
                met += isFound(hit) ? 1 : 0;
            };
            meetsAlike({1e-19f, 2e-19f, 3e-19f}, glm::vec3(1e-18f));
            meetsAlike({1e-19f, -3e-19f, 2e-19f}, {1e-18f, -1e-18f, 1e-18f});
            meetsAlike({1.0f, -0.0f, 1e-30f}, {1.0f, -1e-18f, 1e-18f});
            meetsAlike({0.0f, 1.0f, 0.0f}, {1e-18f, 1.0f, 1e-18f});
        }
        EXPECT_GT(met, 300u);
    }
}

TEST(Bvh16Rays, MeetNothingWhereTheyAreNoNumbers) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const uint32_t count : {0u, 3u, 100u, 1000u}) {
        const Bvh16 bvh = buildBvh16(scatteredTriangles(count, 1.0f, 4));
        std::vector<Bvh16Ray> rays{makeRay({0, 3e38f, 0}, {0.1f, 0.1f, 1})};
        for (const float bad : {nan, kInfinity, -kInfinity}) {
            rays.push_back(makeRay({bad, 0, 0}, {0.1f, 0.1f, 1}));
            rays.push_back(makeRay({0, 0, 0}, {0.1f, bad, 1}));
        }
        for (const Sought sought : {Sought::first, Sought::any})
            for (const Likeness likeness : {Likeness::unlike, Likeness::alike})
                EXPECT_TRUE(std::ranges::none_of(find(bvh, rays, sought, likeness), isFound));
    }
}

TEST(Bvh16Rays, MayBeNone) {
    EXPECT_TRUE(find(buildBvh16(scatteredTriangles(3, 1.0f, 4)), {}, Sought::first).empty());
}

} // namespace
} // namespace lavalight::test
