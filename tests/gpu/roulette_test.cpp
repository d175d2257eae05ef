// Roulette kills by throughput, never before its first vertex, never where it is off, and never not at all.
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shared/frame.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct alignas(16) Question { // as in the kernel
    glm::vec3 throughput;
    uint32_t kind;
    uint32_t vertex;
    uint32_t firstVertex;
};

class RouletteTest : public DeviceTest {
  protected:
    float survival(const Question& question) {
        return KernelRunner(device(), test_kernels::find("roulette_test"))
            .map<float>(std::vector<Question>{question})
            .front();
    }
};

TEST_F(RouletteTest, PathsSurviveByTheirLargestThroughput) {
    EXPECT_EQ(survival({{0.1f, 0.5f, 0.2f}, kRouletteThroughput, 3, 3}), 0.5f);
    EXPECT_EQ(survival({{0.7f, 0.0f, 0.0f}, kRouletteThroughput, 9, 3}), 0.7f);
    EXPECT_EQ(survival({{0.0f, 0.0f, 0.01f}, kRouletteThroughput, 3, 1}), 0.01f);
}

TEST_F(RouletteTest, SomePathsDieHoweverMuchTheyCarry) {
    for (const float throughput : {0.99f, 1.0f, 50.0f}) {
        EXPECT_LT(survival({glm::vec3(throughput), kRouletteThroughput, 3, 3}), 1.0f);
        EXPECT_GE(survival({glm::vec3(throughput), kRouletteThroughput, 3, 3}), 0.9f);
    }
}

TEST_F(RouletteTest, NoPathDiesBeforeTheFirstVertexOrWithRouletteOff) {
    EXPECT_EQ(survival({glm::vec3(0.01f), kRouletteThroughput, 2, 3}), 1.0f);
    EXPECT_EQ(survival({glm::vec3(0.01f), kRouletteOff, 3, 3}), 1.0f);
}

} // namespace
} // namespace lavalight::test
