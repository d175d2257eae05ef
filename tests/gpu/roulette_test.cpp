// Each kind of roulette goes by what its name says, and by nothing else.
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shared/frame.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel
    glm::vec3 color{1.0f};
    uint32_t kind = 0;
    uint32_t vertex = 3;
    uint32_t isSmooth = 0;
    uint32_t pad[2] = {};
};

class RouletteTest : public DeviceTest {
  protected:
    // x: by albedo, y: by throughput.
    glm::vec2 survival(const glm::vec3& color, uint32_t kind) { return answer({color, kind}); }
    bool isSpared(uint32_t kind, uint32_t vertex, bool isSmooth) {
        return answer({glm::vec3(1.0f), kind, vertex, isSmooth ? 1u : 0u}).z != 0.0f;
    }

  private:
    glm::vec4 answer(const Question& question) {
        return KernelRunner(device(), test_kernels::find("roulette_test"))
            .map<glm::vec4>(std::vector<Question>{question})
            .front();
    }
};

TEST_F(RouletteTest, ThroughputGoesByTheLargestChannel) {
    EXPECT_EQ(survival({0.1f, 0.5f, 0.2f}, kRouletteThroughput), glm::vec2(1.0f, 0.5f));
    EXPECT_EQ(survival({0.0f, 0.0f, 0.01f}, kRouletteThroughput), glm::vec2(1.0f, 0.01f));
}

TEST_F(RouletteTest, SqrtThroughputGoesByTheRootOfTheLargestChannel) {
    EXPECT_EQ(survival({0.1f, 0.25f, 0.2f}, kRouletteSqrtThroughput).x, 1.0f);
    EXPECT_NEAR(survival({0.1f, 0.25f, 0.2f}, kRouletteSqrtThroughput).y, 0.5f, 1e-6f);
    EXPECT_NEAR(survival({0.0f, 0.0f, 0.01f}, kRouletteSqrtThroughput).y, 0.1f, 1e-6f);
}

TEST_F(RouletteTest, CbrtThroughputGoesByTheCubeRootOfTheLargestChannel) {
    EXPECT_EQ(survival({0.1f, 0.125f, 0.12f}, kRouletteCbrtThroughput).x, 1.0f);
    EXPECT_NEAR(survival({0.1f, 0.125f, 0.12f}, kRouletteCbrtThroughput).y, 0.5f, 1e-5f);
    EXPECT_NEAR(survival({0.0f, 0.0f, 0.001f}, kRouletteCbrtThroughput).y, 0.1f, 1e-5f);
    EXPECT_EQ(survival(glm::vec3(0.0f), kRouletteCbrtThroughput).y, 0.0f);
}

TEST_F(RouletteTest, CbrtThroughputSparesPathsFromSmoothSurfacesUpToVertex32) {
    EXPECT_TRUE(isSpared(kRouletteCbrtThroughput, 3, true));
    EXPECT_TRUE(isSpared(kRouletteCbrtThroughput, 32, true));
    EXPECT_FALSE(isSpared(kRouletteCbrtThroughput, 33, true));
    EXPECT_FALSE(isSpared(kRouletteCbrtThroughput, 3, false));
}

TEST_F(RouletteTest, NoOtherKindSparesAPath) {
    for (const uint32_t kind : {kRouletteThroughput, kRouletteSqrtThroughput, kRouletteOff, kRouletteConstant,
                                kRouletteMeanAlbedo, kRouletteMaxAlbedo})
        EXPECT_FALSE(isSpared(kind, 3, true)) << kind;
}

TEST_F(RouletteTest, SomePathsDieHoweverMuchTheyCarry) {
    for (const uint32_t kind : {kRouletteThroughput, kRouletteSqrtThroughput, kRouletteCbrtThroughput})
        for (const float throughput : {0.99f, 1.0f, 50.0f}) {
            EXPECT_LT(survival(glm::vec3(throughput), kind).y, 1.0f);
            EXPECT_GE(survival(glm::vec3(throughput), kind).y, 0.9f);
        }
}

TEST_F(RouletteTest, ConstantIsTheSettingsProbability) {
    EXPECT_EQ(survival(glm::vec3(0.9f), kRouletteConstant), glm::vec2(0.3f, 1.0f));
}

TEST_F(RouletteTest, MeanAlbedoStaysBetweenOneTenthAndNineTenths) {
    EXPECT_NEAR(survival({0.2f, 0.4f, 0.9f}, kRouletteMeanAlbedo).x, 0.5f, 1e-6f);
    EXPECT_EQ(survival(glm::vec3(1.0f), kRouletteMeanAlbedo), glm::vec2(0.9f, 1.0f));
    EXPECT_EQ(survival(glm::vec3(0.0f), kRouletteMeanAlbedo), glm::vec2(0.1f, 1.0f));
}

TEST_F(RouletteTest, MaxAlbedoIsTheLargestChannelAndMayBeOne) {
    EXPECT_EQ(survival({0.2f, 0.4f, 0.7f}, kRouletteMaxAlbedo), glm::vec2(0.7f, 1.0f));
    EXPECT_EQ(survival({0.2f, 1.5f, 0.7f}, kRouletteMaxAlbedo), glm::vec2(1.0f, 1.0f));
}

TEST_F(RouletteTest, OffKillsNothing) {
    EXPECT_EQ(survival(glm::vec3(0.01f), kRouletteOff), glm::vec2(1.0f, 1.0f));
}

} // namespace
} // namespace lavalight::test
