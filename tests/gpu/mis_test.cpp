// The weights of two techniques sum to one, and are those of Veach's heuristics.
#include <cmath>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shared/frame.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel
    float own;
    float other;
    uint32_t kind;
};

class MisTest : public DeviceTest {
  protected:
    std::vector<glm::vec2> ask(const std::vector<Question>& questions) {
        return KernelRunner(device(), test_kernels::find("mis_test")).map<glm::vec2>(questions);
    }
};

// Densities from 1e-20 to 1e20, as far apart as a grazed pixel of a distant light and a nearly smooth lobe.
std::vector<Question> questionsOf(uint32_t kind) {
    Random random(1);
    constexpr size_t kCount = 20000;
    std::vector<Question> questions;
    questions.reserve(kCount);
    for (size_t i = 0; i < kCount; ++i)
        questions.push_back({std::pow(10.0f, random.between(-20.0f, 20.0f)),
                             std::pow(10.0f, random.between(-20.0f, 20.0f)), kind});
    return questions;
}

TEST_F(MisTest, WeightsOfBothTechniquesSumToOne) {
    for (const uint32_t kind : {kMisPower, kMisBalance})
        for (const glm::vec2& w : ask(questionsOf(kind))) {
            ASSERT_GE(w.x, 0.0f);
            ASSERT_GE(w.y, 0.0f);
            ASSERT_NEAR(w.x + w.y, 1.0f, 1e-6f);
        }
}

TEST_F(MisTest, WeightsAreThoseOfTheHeuristics) {
    for (const uint32_t kind : {kMisPower, kMisBalance}) {
        const std::vector<Question> questions = questionsOf(kind);
        const std::vector<glm::vec2> weights = ask(questions);
        for (size_t i = 0; i < questions.size(); ++i) {
            const double exponent = kind == kMisPower ? 2.0 : 1.0;
            const double own = std::pow(double{questions[i].own}, exponent);
            const double other = std::pow(double{questions[i].other}, exponent);
            ASSERT_NEAR(weights[i].x, own / (own + other), 1e-6);
        }
    }
}

TEST_F(MisTest, ATechniqueThatCannotFindThePathWeighsNothing) {
    for (const uint32_t kind : {kMisPower, kMisBalance}) {
        EXPECT_EQ(ask({{0.0f, 2.0f, kind}}).front(), glm::vec2(0.0f, 1.0f));
        EXPECT_EQ(ask({{0.0f, 0.0f, kind}}).front(), glm::vec2(0.0f));
    }
}

TEST_F(MisTest, OffWeighsEveryTechniqueFully) {
    EXPECT_EQ(ask({{3.0f, 5.0f, kMisOff}}).front(), glm::vec2(1.0f));
}

} // namespace
} // namespace lavalight::test
