// The oracle answers plain questions as geometry does.
#include "inspect/embree_oracle.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lavalight::test {
namespace {

const std::vector<Triangle> kTwoWalls{{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}},
                                      {{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}};

TEST(EmbreeOracle, ReportsTheNearestTriangleAndItsDistance) {
    const EmbreeOracle oracle(kTwoWalls, EmbreeOracle::Traversal::robust);
    const std::vector<OracleRay> rays{
        {{0, 0, 0}, {0, 0, 1}}, {{0, 0, 3}, {0, 0, -1}}, {{0, 0, 0}, {0, 0, -1}}};
    const std::vector<OracleHit> hits = oracle.closest(rays);
    EXPECT_EQ(hits[0].triangle, 1u);
    EXPECT_FLOAT_EQ(hits[0].t, 1.0f);
    EXPECT_EQ(hits[1].triangle, 0u);
    EXPECT_FLOAT_EQ(hits[1].t, 1.0f);
    EXPECT_TRUE(std::isinf(hits[2].t));
}

TEST(EmbreeOracle, SeesOccludersOnlyUpToTMax) {
    const EmbreeOracle oracle(kTwoWalls, EmbreeOracle::Traversal::fast);
    const std::vector<OracleRay> rays{{{0, 0, 0}, {0, 0, 1}, 0.9f}, {{0, 0, 0}, {0, 0, 1}, 1.1f}};
    EXPECT_EQ(oracle.occluded(rays), (std::vector<uint8_t>{0, 1}));
}

TEST(EmbreeOracle, OfNothingHitsNothing) {
    const EmbreeOracle oracle({}, EmbreeOracle::Traversal::robust);
    const std::vector<OracleRay> rays{{{0, 0, 0}, {0, 0, 1}}};
    EXPECT_TRUE(std::isinf(oracle.closest(rays)[0].t));
    EXPECT_EQ(oracle.occluded(rays)[0], 0u);
}

} // namespace
} // namespace lavalight::test
