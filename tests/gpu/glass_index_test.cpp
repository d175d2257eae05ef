// Glass of every index beside what surrounds it: it is what the quadrature of Walter et al. 2007 says, and
// nothing where the indices match.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "support/glass_quadrature.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "support/test_materials.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel
    glm::vec3 wo;
    float eta;
    glm::vec3 wi;
    float alpha;
    uint32_t isThin;
    uint32_t samples;
    uint32_t unused[2];
};

struct Answer { // as in the kernel
    float reflected;
    float passed;
    float largest;
    float strayed;
    float f;
    float pdf;
    float deltas;
    float wrong;
};

constexpr uint32_t kSamples = 128; // of a batch
constexpr uint32_t kBatches = 32;
const std::vector<float> kRoughnesses = {0.0f, 0.05f, 0.2f, 0.5f, 0.8f, 1.0f};
const std::vector<float> kCosines = {1.0f, 0.7f, 0.25f, 0.03f};
const float kNext = std::nextafter(1.0f, 2.0f);
const float kPrevious = std::nextafter(1.0f, 0.0f);

// Relative indices of files and of nesting: a factor of 3 both ways, a mirror, and all that lies near a
// match.
std::vector<float> indices() {
    std::vector<float> all = {0.0f,    1.0f / 3.0f, 0.5f, 0.75f,  0.9f,     0.99f,   0.999f,
                              0.9999f, kPrevious,   1.0f, kNext,  1.00001f, 1.0001f, 1.0003f,
                              1.001f,  1.01f,       1.1f, 1.333f, 1.5f,     2.0f,    3.0f};
    return all;
}

glm::vec3 woAt(float cosTheta) {
    const float sinTheta = std::sqrt(1.0f - cosTheta * cosTheta);
    return {sinTheta * std::cos(0.7f), sinTheta * std::sin(0.7f), cosTheta};
}

// A thin wall fades over the last thousandth before its index matches.
float fadedAlpha(float alpha, float eta, bool isThin) {
    const float left = std::min(1.0f, std::abs(eta - 1.0f) * 1000.0f);
    return isThin && alpha * left < 1e-3f ? 0.0f : isThin ? alpha * left : alpha;
}

struct Case {
    float eta;
    float roughness;
    float cosTheta;
    bool isThin;
    [[nodiscard]] Question question() const {
        return {woAt(cosTheta), eta,     {0.0f, 0.0f, -1.0f}, roughness * roughness, isThin ? 1u : 0u,
                kSamples,       {0u, 0u}};
    }
    [[nodiscard]] GlassCase reference() const {
        const float alpha = roughness * roughness;
        return {woAt(cosTheta), eta, eta == 1.0f ? 0.0 : fadedAlpha(alpha, eta, isThin), isThin};
    }
    [[nodiscard]] std::string text() const {
        return fmt::format("index {:.8g}, roughness {}, cosine {}, {}", eta, roughness, cosTheta,
                           isThin ? "thin" : "body");
    }
};

std::vector<Case> allCases(const std::vector<float>& etas) {
    std::vector<Case> cases;
    for (const float eta : etas)
        for (const float roughness : kRoughnesses)
            for (const float cosTheta : kCosines)
                for (const bool isThin : {false, true})
                    cases.push_back({eta, roughness, cosTheta, isThin});
    return cases;
}

struct Measured {
    double reflected = 0.0;
    double passed = 0.0;
    double error = 0.0; // standard error of either
    float largest = 0.0f;
    float strayed = 0.0f;
    double deltas = 0.0;
    float wrong = 0.0f;
};

Measured meanOf(std::span<const Answer> batches) {
    Measured m;
    double squares = 0.0;
    const auto n = static_cast<double>(batches.size());
    for (const Answer& a : batches) {
        m.reflected += a.reflected / n;
        m.passed += a.passed / n;
        squares += a.passed * a.passed / n;
        m.largest = std::max(m.largest, a.largest);
        m.strayed = std::max(m.strayed, a.strayed);
        m.deltas += a.deltas / n;
        m.wrong += a.wrong;
    }
    // What is drawn at least once in all samples: a share too small for that has no variance to be seen.
    const double unseen = 10.0 / (kSamples * n);
    m.error = std::sqrt(std::max(squares - m.passed * m.passed, 0.0) / n) + 0.2 * unseen;
    return m;
}

class GlassIndexTest : public DeviceTest {
  protected:
    void SetUp() override {
        DeviceTest::SetUp();
        buffers_.emplace(device(), materials_);
        runner_.emplace(device(), test_kernels::find("glass_index_test"), buffers_->resources());
    }
    [[nodiscard]] std::vector<Answer> ask(const std::vector<Question>& questions) {
        return runner_->map<Answer>(questions);
    }
    // Calls check(case, measured) for each.
    template <typename Check>
    void measure(const std::vector<Case>& cases, const Check& check) {
        std::vector<Question> questions;
        for (const Case& c : cases)
            questions.insert(questions.end(), kBatches, c.question());
        const std::vector<Answer> answers = ask(questions);
        for (size_t i = 0; i < cases.size(); ++i) {
            SCOPED_TRACE(cases[i].text());
            check(cases[i], meanOf(std::span(answers).subspan(i * kBatches, kBatches)));
        }
    }

  private:
    const std::vector<TestMaterial> materials_ = {solidMaterials().front()};
    std::optional<MaterialBuffers> buffers_;
    std::optional<KernelRunner> runner_;
};

TEST_F(GlassIndexTest, MatchedIndexIsNoBoundary) {
    measure(allCases({1.0f}), [](const Case&, const Measured& m) {
        EXPECT_EQ(m.reflected, 0.0);
        EXPECT_EQ(m.passed, 1.0);
        EXPECT_EQ(m.largest, 1.0f);
        EXPECT_LT(m.strayed, 3e-7f);
        EXPECT_EQ(m.deltas, 1.0);
        EXPECT_EQ(m.wrong, 0.0f);
    });
}

TEST_F(GlassIndexTest, AlbedoIsThatOfTheQuadrature) {
    measure(allCases(indices()), [](const Case& c, const Measured& m) {
        const GlassAlbedo expected = glassAlbedo(c.reference());
        EXPECT_NEAR(m.reflected, expected.reflected, 5.0 * m.error + 2e-4);
        EXPECT_NEAR(m.passed, expected.passed, 5.0 * m.error + 2e-4);
        EXPECT_LT(m.reflected + m.passed, 1.0 + 1e-5);
        EXPECT_LT(m.largest, 1.0f + 1e-5f);
        EXPECT_EQ(m.wrong, 0.0f);
        if (c.roughness == 0.0f) {
            EXPECT_NEAR(m.reflected + m.passed, 1.0, 1e-5);
        }
    });
}

// Along the normal nothing is masked where little is bent, and light passes ever straighter.
TEST_F(GlassIndexTest, AlbedoAlongTheNormalDoesNotJumpWhereIndicesMatch) {
    std::vector<Case> cases;
    for (const float difference : {1e-7f, 1e-6f, 1e-5f, 1e-4f})
        for (const float eta : {1.0f - difference, 1.0f + difference})
            for (const float roughness : kRoughnesses)
                for (const bool isThin : {false, true})
                    cases.push_back({eta, roughness, 1.0f, isThin});
    measure(cases, [](const Case& c, const Measured& m) {
        EXPECT_NEAR(m.passed, 1.0, c.isThin ? 0.02 : 0.002);
        EXPECT_LT(m.strayed, c.isThin ? 2.0f : 4000.0f * std::abs(c.eta - 1.0f) + 1e-6f);
    });
}

// What light sampling asks for: the sum over all directions, found from the facets that lead there.
TEST_F(GlassIndexTest, DensitiesAndValuesAddUpOverAllDirections) {
    for (const float eta : {1.0f / 3.0f, 0.75f, 0.99f, 0.9994f, 1.0006f, 1.01f, 1.333f, 3.0f})
        for (const float roughness : {0.5f, 0.8f, 1.0f})
            for (const float cosTheta : {1.0f, 0.7f, 0.25f})
                for (const bool isThin : {false, true}) {
                    Case c{eta, roughness, cosTheta, isThin};
                    const GlassCase reference = c.reference();
                    SCOPED_TRACE(c.text());
                    const std::vector<FacetDirection> directions = facetDirections(reference, 128);
                    std::vector<Question> questions;
                    for (const FacetDirection& d : directions) {
                        questions.push_back(c.question());
                        questions.back().samples = 0;
                        questions.back().wi = d.wi;
                    }
                    const std::vector<Answer> answers = ask(questions);
                    double density = 0.0;
                    double flux = 0.0;
                    for (size_t i = 0; i < answers.size(); ++i) {
                        const bool enters = directions[i].wi.z < 0.0 && !isThin;
                        density += answers[i].pdf * directions[i].solidAngle;
                        flux += answers[i].f * directions[i].solidAngle * (enters ? eta * eta : 1.0);
                    }
                    const GlassAlbedo expected = glassAlbedo(reference);
                    EXPECT_LE(density, 1.005);
                    EXPECT_NEAR(flux, expected.reflected + expected.passed, 0.005);
                }
}

TEST_F(GlassIndexTest, NothingPassesAMirrorOfIndexZero) {
    std::vector<Question> questions;
    for (const Case& c : allCases({0.0f}))
        for (const glm::vec3& wi :
             {glm::vec3(0.0f, 0.0f, -1.0f), {0.6f, 0.0f, -0.8f}, {0.0f, -0.8f, -0.6f}}) {
            questions.push_back(c.question());
            questions.back().samples = 0;
            questions.back().wi = wi;
        }
    for (const Answer& answer : ask(questions)) {
        EXPECT_EQ(answer.f, 0.0f);
        EXPECT_EQ(answer.pdf, 0.0f);
    }
}

} // namespace
} // namespace lavalight::test
